#pragma once
// HDF5 files that are built and read in memory, and sealed on disk (io/seal.hpp): so HDF5 never meets a full
// disk, nor a file that is cut or changed (its reader can crash on such), and equal content gives equal bytes
// (no time stamps).
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/seal.hpp"

namespace packbed {

/// Objects are named by absolute paths; groups on the way are made. All calls throw std::runtime_error.
class Hdf5Writer {
 public:
  Hdf5Writer();                                  ///< in memory
  explicit Hdf5Writer(const std::string& path);  ///< on disk, for what may not fit into memory; not sealed
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// A data set of values.size() / columns rows; columns 1 makes it one-dimensional. T: double, float,
  /// int32_t, int64_t, uint32_t, uint64_t, uint8_t.
  template <class T>
  void array(const std::string& path, const std::vector<T>& values, std::size_t columns = 1);
  /// Rows behind those that are there; the first call makes the data set.
  template <class T>
  void append(const std::string& path, const std::vector<T>& values, std::size_t columns = 1);
  void text(const std::string& path, const std::string& value);  ///< a scalar string data set
  /// A three-dimensional data set made slice by slice, so that it is never whole in memory: fill(z, slice)
  /// writes the size[1] x size[2] values of slice z. T: uint8_t, int32_t, uint64_t.
  template <class T>
  void volume(const std::string& path, const std::array<std::size_t, 3>& size,
              const std::function<void(std::size_t, T*)>& fill);
  void group(const std::string& path);
  /// On a group or data set that exists already.
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, double value);
  void attribute(const std::string& path, const std::string& name, std::uint64_t value);
  void attribute(const std::string& path, const std::string& name, const std::vector<double>& values);
  void attribute(const std::string& path, const std::string& name, const std::vector<std::int64_t>& values);

  std::string image();  ///< the bytes of the file so far (in memory only)
  void close();         ///< throws when not everything could be written

 private:
  struct File;
  std::unique_ptr<File> file_;
};

class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::string image);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  bool has(const std::string& path) const;
  /// Throws when there is none, its columns differ, or its type is not T.
  template <class T>
  std::vector<T> array(const std::string& path, std::size_t columns = 1) const;
  /// A three-dimensional data set; `size` receives its size. T: int32_t, uint64_t.
  template <class T>
  std::vector<T> volume(const std::string& path, std::array<std::size_t, 3>& size) const;
  std::string text(const std::string& path) const;
  std::string text_attribute(const std::string& path, const std::string& name) const;
  double number_attribute(const std::string& path, const std::string& name) const;
  std::uint64_t count_attribute(const std::string& path, const std::string& name) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace packbed
