#include "io/grid.hpp"

#include <algorithm>
#include <filesystem>

#include "io/atomic_file.hpp"
#include "io/hdf5_image.hpp"
#include "io/result_folder.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

constexpr const char* kKind = "grid";
constexpr const char* kWords = "/grid/solid";                // bits: (nz, ny, words a row) of 64-bit words
constexpr const char* kLabels = "/VTKHDF/PointData/pellet";  // (nz, ny, nx): 0 void, pellet id + 1

std::array<std::size_t, 3> voxels(const GridFrame& f) {
  return {static_cast<std::size_t>(f.size[2]), static_cast<std::size_t>(f.size[1]),
          static_cast<std::size_t>(f.size[0])};
}

void write_bits(Hdf5Writer& file, const VoxelGrid& grid, const GridNote& note) {
  const GridFrame& f = grid.frame;
  const std::size_t slice = grid.frame.words_per_row() * static_cast<std::size_t>(f.size[1]);
  file.volume<std::uint64_t>(
      kWords, {voxels(f)[0], voxels(f)[1], f.words_per_row()}, [&](std::size_t z, std::uint64_t* out) {
        std::copy_n(grid.words.begin() + static_cast<std::ptrdiff_t>(z * slice), slice, out);
      });
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    file.attribute("/grid", "size_" + axis, static_cast<std::uint64_t>(f.size[d]));
    file.attribute("/grid", "origin_" + axis + "_m", f.origin[static_cast<Eigen::Index>(d)]);
  }
  file.attribute("/grid", "pitch_m", f.pitch);
  file.attribute("/grid", "doubled", static_cast<std::uint64_t>(grid.doubled));
  file.attribute("/grid", "container_radius_m", note.container_radius);
  file.attribute("/grid", "diameter_m", note.diameter);
  file.attribute("/grid", "source", note.source);
}

void write_labels(Hdf5Writer& file, const VoxelGrid& grid) {
  const auto size = voxels(grid.frame);
  file.volume<std::int32_t>(kLabels, size, [&](std::size_t z, std::int32_t* out) {
    const std::size_t slice = size[1] * size[2];
    std::copy_n(grid.labels.begin() + static_cast<std::ptrdiff_t>(z * slice), slice, out);
  });
}

/// VTKHDF 1.0 ImageData with point data: the reader of VTK 9.1 fails on cell data and warns of version 2.0.
void write_image(Hdf5Writer& file, const VoxelGrid& grid) {
  const GridFrame& f = grid.frame;
  file.volume<std::uint8_t>("/VTKHDF/PointData/solid", voxels(f), [&](std::size_t z, std::uint8_t* out) {
    for (int y = 0; y < f.size[1]; ++y) {
      const std::uint64_t* row = grid.words.data() + grid.row(y, static_cast<int>(z));
      for (int x = 0; x < f.size[0]; ++x) *out++ = (row[x / 64] >> (x % 64)) & 1U;
    }
  });
  if (!grid.labels.empty()) write_labels(file, grid);
  const Vec3 first = f.centre(0, 0, 0);
  file.attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  file.attribute("/VTKHDF", "Type", std::string("ImageData"));
  file.attribute("/VTKHDF", "WholeExtent",
                 std::vector<std::int64_t>{0, f.size[0] - 1, 0, f.size[1] - 1, 0, f.size[2] - 1});
  file.attribute("/VTKHDF", "Origin", std::vector<double>{first.x(), first.y(), first.z()});
  file.attribute("/VTKHDF", "Spacing", std::vector<double>{f.pitch, f.pitch, f.pitch});
  file.attribute("/VTKHDF", "Direction", std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
}

GridFile from_hdf5(const Hdf5Reader& file) {
  GridFile out;
  GridFrame frame;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    frame.size[d] = static_cast<int>(file.count_attribute("/grid", "size_" + axis));
    frame.origin[static_cast<Eigen::Index>(d)] = file.number_attribute("/grid", "origin_" + axis + "_m");
  }
  frame.pitch = file.number_attribute("/grid", "pitch_m");
  out.grid.frame = frame;
  std::array<std::size_t, 3> size{};
  out.grid.words = file.volume<std::uint64_t>(kWords, size);
  if (size != std::array{voxels(frame)[0], voxels(frame)[1], frame.words_per_row()})
    throw std::runtime_error("the size of the bits is not that of the grid");
  if (file.has(kLabels)) out.grid.labels = file.volume<std::int32_t>(kLabels, size);
  out.grid.doubled = static_cast<std::int64_t>(file.count_attribute("/grid", "doubled"));
  out.note = {file.number_attribute("/grid", "container_radius_m"),
              file.number_attribute("/grid", "diameter_m"), file.text_attribute("/grid", "source")};
  return out;
}

}  // namespace

void write_grid(const std::string& path, const VoxelGrid& grid, const GridNote& note) {
  std::string bytes;
  try {
    Hdf5Writer file;
    write_bits(file, grid, note);
    write_image(file, grid);
    bytes = file.image();
  } catch (const std::runtime_error& e) {
    throw SystemError(path + ": " + e.what());
  }
  write_atomically(path, sealed(bytes, kKind));
}

GridFile read_grid(const std::string& path_or_folder) {
  const std::string path = file_in(path_or_folder, result_file::kVoxels);
  try {
    return from_hdf5(Hdf5Reader(unsealed_file(path, kKind)));
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw InputError(path, e.what(), "a voxels.h5 as packbed wrote it", "voxelise the bed again");
  }
}

bool is_grid_file(const std::string& path) {
  return is_sealed_as(path, kKind);
}

bool holds_grid(const std::string& path_or_folder) {
  if (!std::filesystem::is_directory(path_or_folder)) return is_grid_file(path_or_folder);
  const ResultFolder folder{path_or_folder};
  return !folder.has(result_file::kBed) && folder.has(result_file::kVoxels);
}

}  // namespace packbed
