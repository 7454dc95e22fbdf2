#include "io/hdf5_image.hpp"

#include <hdf5.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace packbed {
namespace {

constexpr std::size_t kMemoryStep = 1 << 20;  // by which the image grows [byte]
constexpr std::size_t kCompressFrom = 4096;   // smaller arrays are kept as they are [byte]
constexpr hsize_t kChunkRows = 16384;         // a chunk is the unit of compression
constexpr hsize_t kGrowingRows = 4096;        // of a data set that grows by frames

/// An HDF5 id that closes itself. Negative ids become exceptions at once.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t), const std::string& doing) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("HDF5: " + doing + " failed");
  }
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Id& operator=(Id&&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void need(herr_t status, const std::string& doing) {
  if (status < 0) throw std::runtime_error("HDF5: " + doing + " failed");
}

template <class T>
hid_t type_of();
template <>
hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t type_of<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t type_of<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t type_of<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t type_of<std::uint32_t>() {
  return H5T_NATIVE_UINT32;
}
template <>
hid_t type_of<std::uint64_t>() {
  return H5T_NATIVE_UINT64;
}
template <>
hid_t type_of<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

Id memory_access() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors come back as exceptions, not as prints
  return Id(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "preparing memory");
}

Id parents_on_the_way() {
  Id list(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "preparing a link");
  need(H5Pset_create_intermediate_group(list, 1), "preparing a link");
  return list;
}

Id string_type(std::size_t length) {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose, "making a string type");
  need(H5Tset_size(type, std::max<std::size_t>(length, 1)), "making a string type");
  need(H5Tset_cset(type, H5T_CSET_UTF8), "making a string type");
  need(H5Tset_strpad(type, H5T_STR_NULLPAD), "making a string type");
  return type;
}

Id untimed(hid_t kind) {
  Id list(H5Pcreate(kind), H5Pclose, "preparing an object");
  need(H5Pset_obj_track_times(list, false), "preparing an object");
  return list;
}

std::string padded(const std::string& value) {
  return value.empty() ? std::string(1, '\0') : value;
}

std::string unpadded(std::string value) {
  while (!value.empty() && value.back() == '\0') value.pop_back();
  return value;
}

}  // namespace

struct Hdf5Writer::File {
  hid_t id = -1;
};

Hdf5Writer::Hdf5Writer() : file_(std::make_unique<File>()) {
  const Id access = memory_access();
  need(H5Pset_fapl_core(access, kMemoryStep, false), "preparing memory");
  const Id creation = untimed(H5P_FILE_CREATE);
  file_->id = H5Fcreate("packbed.h5", H5F_ACC_TRUNC, creation, access);
  need(file_->id < 0 ? -1 : 0, "making a file in memory");
}

Hdf5Writer::Hdf5Writer(const std::string& path) : file_(std::make_unique<File>()) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Id creation = untimed(H5P_FILE_CREATE);
  file_->id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
  need(file_->id < 0 ? -1 : 0, "making " + path);
}

Hdf5Writer::~Hdf5Writer() {
  if (file_->id >= 0) H5Fclose(file_->id);
}

void Hdf5Writer::close() {
  need(H5Fclose(std::exchange(file_->id, -1)), "writing the file (is the disk full?)");
}

template <class T>
void Hdf5Writer::array(const std::string& path, const std::vector<T>& values, std::size_t columns) {
  const hsize_t size[2] = {values.size() / columns, columns};
  const int rank = columns == 1 ? 1 : 2;
  const Id space(H5Screate_simple(rank, size, nullptr), H5Sclose, "sizing " + path);
  const Id creation = untimed(H5P_DATASET_CREATE);
  if (values.size() * sizeof(T) >= kCompressFrom) {
    const hsize_t chunk[2] = {std::min(size[0], kChunkRows), columns};
    need(H5Pset_chunk(creation, rank, chunk), "chunking " + path);
    need(H5Pset_shuffle(creation), "compressing " + path);
    need(H5Pset_deflate(creation, 4), "compressing " + path);
  }
  const Id links = parents_on_the_way();
  const Id data(H5Dcreate2(file_->id, path.c_str(), type_of<T>(), space, links, creation, H5P_DEFAULT),
                H5Dclose, "making " + path);
  if (!values.empty())
    need(H5Dwrite(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "writing " + path);
}

namespace {

/// An empty data set that can grow.
template <class T>
void make_growing(hid_t file, const std::string& path, std::size_t columns) {
  const hsize_t size[2] = {0, columns}, most[2] = {H5S_UNLIMITED, columns},
                chunk[2] = {kGrowingRows, columns};
  const int rank = columns == 1 ? 1 : 2;
  const Id space(H5Screate_simple(rank, size, most), H5Sclose, "sizing " + path);
  const Id creation = untimed(H5P_DATASET_CREATE);
  need(H5Pset_chunk(creation, rank, chunk), "chunking " + path);
  need(H5Pset_shuffle(creation), "compressing " + path);
  need(H5Pset_deflate(creation, 4), "compressing " + path);
  const Id links = parents_on_the_way();
  const Id made(H5Dcreate2(file, path.c_str(), type_of<T>(), space, links, creation, H5P_DEFAULT), H5Dclose,
                "making " + path);
}

}  // namespace

template <class T>
void Hdf5Writer::append(const std::string& path, const std::vector<T>& values, std::size_t columns) {
  if (H5Lexists(file_->id, path.c_str(), H5P_DEFAULT) <= 0) make_growing<T>(file_->id, path, columns);
  if (values.empty()) return;
  const int rank = columns == 1 ? 1 : 2;
  const Id data(H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), H5Dclose, "opening " + path);
  hsize_t old[2] = {0, columns};
  {
    const Id space(H5Dget_space(data), H5Sclose, "asking the size of " + path);
    need(H5Sget_simple_extent_dims(space, old, nullptr), "asking the size of " + path);
  }
  const hsize_t added[2] = {values.size() / columns, columns}, start[2] = {old[0], 0};
  const hsize_t whole[2] = {old[0] + added[0], columns};
  need(H5Dset_extent(data, whole), "growing " + path);
  const Id space(H5Dget_space(data), H5Sclose, "asking the size of " + path);
  need(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, added, nullptr),
       "choosing rows of " + path);
  const Id memory(H5Screate_simple(rank, added, nullptr), H5Sclose, "sizing " + path);
  need(H5Dwrite(data, type_of<T>(), memory, space, H5P_DEFAULT, values.data()), "writing " + path);
}

template <class T>
void Hdf5Writer::volume(const std::string& path, const std::array<std::size_t, 3>& size,
                        const std::function<void(std::size_t, T*)>& fill) {
  const hsize_t whole[3] = {size[0], size[1], size[2]}, slice[3] = {1, size[1], size[2]};
  const Id space(H5Screate_simple(3, whole, nullptr), H5Sclose, "sizing " + path);
  const Id creation = untimed(H5P_DATASET_CREATE);
  need(H5Pset_chunk(creation, 3, slice), "chunking " + path);
  need(H5Pset_deflate(creation, 1), "compressing " + path);  // more gains little on grids and takes long
  const Id links = parents_on_the_way();
  const Id data(H5Dcreate2(file_->id, path.c_str(), type_of<T>(), space, links, creation, H5P_DEFAULT),
                H5Dclose, "making " + path);
  const Id memory(H5Screate_simple(3, slice, nullptr), H5Sclose, "sizing " + path);
  std::vector<T> values(size[1] * size[2]);
  for (std::size_t z = 0; z < size[0]; ++z) {
    fill(z, values.data());
    const hsize_t from[3] = {z, 0, 0};
    need(H5Sselect_hyperslab(space, H5S_SELECT_SET, from, nullptr, slice, nullptr), "selecting in " + path);
    need(H5Dwrite(data, type_of<T>(), memory, space, H5P_DEFAULT, values.data()), "writing " + path);
  }
}

void Hdf5Writer::text(const std::string& path, const std::string& value) {
  const std::string bytes = padded(value);
  const Id type = string_type(bytes.size());
  const Id space(H5Screate(H5S_SCALAR), H5Sclose, "sizing " + path);
  const Id creation = untimed(H5P_DATASET_CREATE);
  const Id links = parents_on_the_way();
  const Id data(H5Dcreate2(file_->id, path.c_str(), type, space, links, creation, H5P_DEFAULT), H5Dclose,
                "making " + path);
  need(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), "writing " + path);
}

void Hdf5Writer::group(const std::string& path) {
  const Id links = parents_on_the_way();
  const Id creation = untimed(H5P_GROUP_CREATE);
  const Id made(H5Gcreate2(file_->id, path.c_str(), links, creation, H5P_DEFAULT), H5Gclose,
                "making " + path);
}

namespace {

/// One value, or a list when count is not 0.
void put_attribute(hid_t file, const std::string& path, const std::string& name, hid_t type,
                   const void* value, hsize_t count = 0) {
  const Id object(H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose, "opening " + path);
  const Id space(count ? H5Screate_simple(1, &count, nullptr) : H5Screate(H5S_SCALAR), H5Sclose,
                 "sizing " + name);
  const Id made(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                "making " + name);
  need(H5Awrite(made, type, value), "writing " + name);
}

}  // namespace

void Hdf5Writer::attribute(const std::string& path, const std::string& name, const std::string& value) {
  const std::string bytes = padded(value);
  put_attribute(file_->id, path, name, string_type(bytes.size()), bytes.data());
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, double value) {
  put_attribute(file_->id, path, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, std::uint64_t value) {
  put_attribute(file_->id, path, name, H5T_NATIVE_UINT64, &value);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name,
                           const std::vector<double>& values) {
  put_attribute(file_->id, path, name, H5T_NATIVE_DOUBLE, values.data(), values.size());
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name,
                           const std::vector<std::int64_t>& values) {
  put_attribute(file_->id, path, name, H5T_NATIVE_INT64, values.data(), values.size());
}

std::string Hdf5Writer::image() {
  need(H5Fflush(file_->id, H5F_SCOPE_LOCAL), "finishing the file");
  const ssize_t size = H5Fget_file_image(file_->id, nullptr, 0);
  if (size < 0) throw std::runtime_error("HDF5: the size of the file is not known");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file_->id, bytes.data(), bytes.size()) != size)
    throw std::runtime_error("HDF5: copying the file failed");
  return bytes;
}

struct Hdf5Reader::File {
  std::string image;
  hid_t id = -1;
};

Hdf5Reader::Hdf5Reader(std::string image) : file_(std::make_unique<File>()) {
  file_->image = std::move(image);
  const Id access = memory_access();
  need(H5Pset_fapl_core(access, kMemoryStep, false), "preparing memory");
  need(H5Pset_file_image(access, file_->image.data(), file_->image.size()), "loading the file");
  file_->id = H5Fopen("packbed.h5", H5F_ACC_RDONLY, access);
  need(file_->id < 0 ? -1 : 0, "opening the file");
}

Hdf5Reader::~Hdf5Reader() {
  H5Fclose(file_->id);
}

bool Hdf5Reader::has(const std::string& path) const {
  for (std::size_t at = path.find('/', 1);; at = path.find('/', at + 1)) {
    if (H5Lexists(file_->id, path.substr(0, at).c_str(), H5P_DEFAULT) <= 0) return false;
    if (at == std::string::npos) return true;
  }
}

template <class T>
std::vector<T> Hdf5Reader::array(const std::string& path, std::size_t columns) const {
  const Id data(H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), H5Dclose, "opening " + path);
  const Id type(H5Dget_type(data), H5Tclose, "asking the type of " + path);
  const Id space(H5Dget_space(data), H5Sclose, "asking the size of " + path);
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank != (columns == 1 ? 1 : 2) || H5Sget_simple_extent_dims(space, size, nullptr) < 0 ||
      (rank == 2 && size[1] != columns) || H5Tequal(type, type_of<T>()) <= 0)
    throw std::runtime_error(path + " has another form than expected");
  std::vector<T> values(size[0] * columns);
  if (!values.empty())
    need(H5Dread(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "reading " + path);
  return values;
}

template <class T>
std::vector<T> Hdf5Reader::volume(const std::string& path, std::array<std::size_t, 3>& size) const {
  const Id data(H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), H5Dclose, "opening " + path);
  const Id type(H5Dget_type(data), H5Tclose, "asking the type of " + path);
  const Id space(H5Dget_space(data), H5Sclose, "asking the size of " + path);
  hsize_t extent[3] = {0, 0, 0};
  if (H5Sget_simple_extent_ndims(space) != 3 || H5Sget_simple_extent_dims(space, extent, nullptr) < 0 ||
      H5Tequal(type, type_of<T>()) <= 0)
    throw std::runtime_error(path + " has another form than expected");
  size = {extent[0], extent[1], extent[2]};
  std::vector<T> values(size[0] * size[1] * size[2]);
  if (!values.empty())
    need(H5Dread(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "reading " + path);
  return values;
}

std::string Hdf5Reader::text(const std::string& path) const {
  const Id data(H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), H5Dclose, "opening " + path);
  const Id type(H5Dget_type(data), H5Tclose, "asking the type of " + path);
  if (H5Tget_class(type) != H5T_STRING) throw std::runtime_error(path + " is no text");
  std::string value(H5Tget_size(type), '\0');
  need(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), "reading " + path);
  return unpadded(std::move(value));
}

namespace {

Id opened_attribute(hid_t file, const std::string& path, const std::string& name) {
  return Id(H5Aopen_by_name(file, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
            "opening " + path + "@" + name);
}

}  // namespace

std::string Hdf5Reader::text_attribute(const std::string& path, const std::string& name) const {
  const Id attribute = opened_attribute(file_->id, path, name);
  const Id type(H5Aget_type(attribute), H5Tclose, "asking the type of " + name);
  if (H5Tget_class(type) != H5T_STRING) throw std::runtime_error(path + "@" + name + " is no text");
  std::string value(H5Tget_size(type), '\0');
  need(H5Aread(attribute, type, value.data()), "reading " + name);
  return unpadded(std::move(value));
}

double Hdf5Reader::number_attribute(const std::string& path, const std::string& name) const {
  double value = 0;
  need(H5Aread(opened_attribute(file_->id, path, name), H5T_NATIVE_DOUBLE, &value), "reading " + name);
  return value;
}

std::uint64_t Hdf5Reader::count_attribute(const std::string& path, const std::string& name) const {
  std::uint64_t value = 0;
  need(H5Aread(opened_attribute(file_->id, path, name), H5T_NATIVE_UINT64, &value), "reading " + name);
  return value;
}

#define PACKBED_HDF5_TYPE(T)                                                                   \
  template void Hdf5Writer::array<T>(const std::string&, const std::vector<T>&, std::size_t);  \
  template void Hdf5Writer::append<T>(const std::string&, const std::vector<T>&, std::size_t); \
  template std::vector<T> Hdf5Reader::array<T>(const std::string&, std::size_t) const;
PACKBED_HDF5_TYPE(double)
PACKBED_HDF5_TYPE(float)
PACKBED_HDF5_TYPE(std::int32_t)
PACKBED_HDF5_TYPE(std::int64_t)
PACKBED_HDF5_TYPE(std::uint32_t)
PACKBED_HDF5_TYPE(std::uint64_t)
PACKBED_HDF5_TYPE(std::uint8_t)
#undef PACKBED_HDF5_TYPE
#define PACKBED_HDF5_VOLUME(T)                                                               \
  template void Hdf5Writer::volume<T>(const std::string&, const std::array<std::size_t, 3>&, \
                                      const std::function<void(std::size_t, T*)>&);          \
  template std::vector<T> Hdf5Reader::volume<T>(const std::string&, std::array<std::size_t, 3>&) const;
PACKBED_HDF5_VOLUME(std::int32_t)
PACKBED_HDF5_VOLUME(std::uint64_t)
PACKBED_HDF5_VOLUME(std::uint8_t)
#undef PACKBED_HDF5_VOLUME

}  // namespace packbed
