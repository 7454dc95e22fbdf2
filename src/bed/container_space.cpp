// The inside of a container, voxel by voxel.
#include <algorithm>
#include <cmath>

#include "bed/voxelise.hpp"
#include "lattice/rasterise.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

/// Bits of `seed` and all `free` bits joined to them along the row.
void spread(const std::uint64_t* free, std::uint64_t* seed, std::size_t words) {
  std::uint64_t carry = 0;  // to the right: an addition runs through a block of ones
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t g = seed[w] | (carry & free[w]), p = free[w];
    for (int s = 1; s < 64; s *= 2) {  // Kogge & Stone, IEEE Trans. Comput. C-22, 1973
      g |= p & (g << s);
      p &= p << s;
    }
    seed[w] = g;
    carry = g >> 63;
  }
  carry = 0;
  for (std::size_t w = words; w-- > 0;) {  // to the left
    std::uint64_t g = seed[w] | ((carry << 63) & free[w]), p = free[w];
    for (int s = 1; s < 64; s *= 2) {
      g |= p & (g >> s);
      p &= p >> s;
    }
    seed[w] = g;
    carry = g & 1;
  }
}

/// Cells of one slice that are neither wall nor joined to the slice's edge.
void inside_of_slice(const std::uint64_t* wall, std::uint64_t* inside, int nx, int ny, std::size_t words) {
  const std::size_t total = words * static_cast<std::size_t>(ny);
  std::vector<std::uint64_t> free(total), out(total, 0);
  const std::uint64_t tail = nx % 64 == 0 ? ~std::uint64_t{0} : ~(~std::uint64_t{0} << (nx % 64));
  for (std::size_t i = 0; i < total; ++i)
    free[i] = ~wall[i] & (i % words == words - 1 ? tail : ~std::uint64_t{0});
  for (std::size_t y = 0; y < static_cast<std::size_t>(ny); ++y) {
    std::uint64_t* row = out.data() + y * words;
    const std::uint64_t* f = free.data() + y * words;
    if (y == 0 || y + 1 == static_cast<std::size_t>(ny)) std::copy(f, f + words, row);
    row[0] |= f[0] & 1;
    row[words - 1] |= f[words - 1] & (std::uint64_t{1} << ((nx - 1) % 64));
    spread(f, row, words);
  }
  for (bool grew = true; grew;) {
    grew = false;
    const auto from_row = [&](std::size_t y, std::size_t other) {
      std::uint64_t *row = out.data() + y * words, news = 0;
      const std::uint64_t* f = free.data() + y * words;
      for (std::size_t w = 0; w < words; ++w) {
        const std::uint64_t add = out[other * words + w] & f[w] & ~row[w];
        row[w] |= add;
        news |= add;
      }
      if (!news) return;
      spread(f, row, words);
      grew = true;
    };
    for (std::size_t y = 1; y < static_cast<std::size_t>(ny); ++y) from_row(y, y - 1);
    for (std::size_t y = static_cast<std::size_t>(ny) - 1; y-- > 0;) from_row(y, y + 1);
  }
  for (std::size_t i = 0; i < total; ++i) inside[i] = free[i] & ~out[i];
}

VoxelGrid space_of_mesh(const Container& container, const GridFrame& frame) {
  constexpr int kSlab = 64;
  VoxelGrid space(frame);
  const std::size_t slabs = static_cast<std::size_t>((frame.size[2] + kSlab - 1) / kSlab);
  parallel_for(slabs, 1, [&](std::size_t begin, std::size_t end) {
    Rasteriser rasteriser(frame);
    for (std::size_t s = begin; s < end; ++s) {
      const int z0 = static_cast<int>(s) * kSlab, z1 = std::min(z0 + kSlab, frame.size[2]);
      merge(rasteriser.mesh(container.surface, Pose{}, 1, z0, z1), space, 1);
      for (int z = z0; z < z1; ++z) {
        std::uint64_t* slice = space.words.data() + space.row(0, z);
        inside_of_slice(slice, slice, frame.size[0], frame.size[1], frame.words_per_row());
      }
    }
  });
  return space;
}

}  // namespace

VoxelGrid container_space(const Container& container, const GridFrame& frame) {
  if (container.kind == ContainerKind::mesh) return space_of_mesh(container, frame);
  GridFrame slice = frame;
  slice.size[2] = 1;
  VoxelGrid space(slice);
  const auto within = [&](const Vec3& x) {
    if (container.kind == ContainerKind::tube)
      return x.head<2>().squaredNorm() <= container.radius * container.radius;
    if (container.kind == ContainerKind::box)
      return std::abs(x.x()) <= 0.5 * container.width && std::abs(x.y()) <= 0.5 * container.depth;
    return true;
  };
  for (int y = 0; y < slice.size[1]; ++y)
    for (int x = 0; x < slice.size[0]; ++x)
      if (within(slice.centre(x, y, 0)))
        space.words[space.row(y, 0) + static_cast<std::size_t>(x) / 64] |= std::uint64_t{1} << (x % 64);
  return space;
}

}  // namespace packbed
