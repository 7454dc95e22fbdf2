#pragma once
// Plain values and vectors of them as bytes and back, for checkpoints. A visit(io, state) that names every
// member once serves both ways.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "math/error.hpp"

namespace packbed {

class ArchiveWriter {
 public:
  std::vector<std::byte> bytes;
  template <class T>
  void operator()(const T& value) {
    raw(&value, sizeof(T));
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    raw(values.data(), values.size() * sizeof(T));
  }

 private:
  void raw(const void* data, std::size_t size) {
    if (size == 0) return;
    const std::size_t at = bytes.size();
    bytes.resize(at + size);
    std::memcpy(bytes.data() + at, data, size);
  }
};

class ArchiveReader {
 public:
  /// `what` names the run in the message of a SystemError.
  ArchiveReader(std::span<const std::byte> bytes, const char* what) : bytes_(bytes), what_(what) {}
  template <class T>
  void operator()(T& value) {
    raw(&value, sizeof(T));
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t n = 0;
    (*this)(n);
    if (n > bytes_.size() / sizeof(T)) fail();
    values.resize(n);
    raw(values.data(), n * sizeof(T));
  }
  bool at_end() const { return bytes_.empty(); }
  [[noreturn]] void fail() const {
    throw SystemError(std::string("checkpoint: not the state of a ") + what_ + " run");
  }

 private:
  void raw(void* data, std::size_t size) {
    if (size == 0) return;
    if (size > bytes_.size()) fail();
    std::memcpy(data, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  std::span<const std::byte> bytes_;
  const char* what_;
};

}  // namespace packbed
