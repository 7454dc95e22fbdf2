#pragma once
// A regular grid of one bit a voxel. Arrays are (z, y, x), x fastest; a row of x is padded to whole 64-bit
// words.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/types.hpp"

namespace packbed {

struct GridFrame {
  Vec3 origin = Vec3::Zero();        // lower corner of voxel (0, 0, 0) [m]
  double pitch = 0;                  // edge of a voxel [m]
  std::array<int, 3> size{0, 0, 0};  // voxels along x, y, z

  Vec3 centre(int x, int y, int z) const { return origin + pitch * Vec3(x + 0.5, y + 0.5, z + 0.5); }
  std::size_t words_per_row() const { return (static_cast<std::size_t>(size[0]) + 63) / 64; }
};

struct VoxelGrid {
  GridFrame frame;
  std::vector<std::uint64_t>
      words;  // solid bits (nz, ny, words_per_row); bit i of word w is voxel x = 64 w + i
  std::vector<std::int32_t> labels;  // 0 void, pellet id + 1 solid (nz, ny, nx); empty unless asked for

  std::int64_t doubled = 0;  // voxels found solid again by a further pellet: where pellets overlap

  VoxelGrid() = default;
  explicit VoxelGrid(const GridFrame& f)
      : frame(f),
        words(f.words_per_row() * static_cast<std::size_t>(f.size[1]) * static_cast<std::size_t>(f.size[2])) {
  }
  std::size_t row(int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(frame.size[1]) +
            static_cast<std::size_t>(y)) *
           frame.words_per_row();
  }
  bool solid(int x, int y, int z) const {
    return (words[row(y, z) + static_cast<std::size_t>(x) / 64] >> (x % 64)) & 1U;
  }
};

}  // namespace packbed
