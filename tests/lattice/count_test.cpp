// Counting by words against counting one by one.
#include "lattice/count.hpp"

#include <gtest/gtest.h>

#include "math/random.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

VoxelGrid random_grid(std::array<int, 3> size, double density, std::uint32_t seed) {
  GridFrame frame;
  frame.pitch = 1;
  frame.size = size;
  VoxelGrid grid(frame);
  Random r(seed, Stream::test, 0);
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x)
        if (r.uniform() < density)
          grid.words[grid.row(y, z) + static_cast<std::size_t>(x) / 64] |= std::uint64_t{1} << (x % 64);
  return grid;
}

/// Both counts, one voxel at a time.
void check(const VoxelGrid& grid, const VoxelGrid& space, int z_begin, int z_end) {
  const auto slices = slice_counts(grid, space);
  const auto columns = column_counts(grid, space, z_begin, z_end);
  std::vector<std::int64_t> by_slice(slices.size(), 0);
  std::vector<std::int32_t> by_column(columns.size(), 0);
  for (int z = 0; z < grid.frame.size[2]; ++z)
    for (int y = 0; y < grid.frame.size[1]; ++y)
      for (int x = 0; x < grid.frame.size[0]; ++x) {
        if (!grid.solid(x, y, z) || !space.solid(x, y, space.frame.size[2] == 1 ? 0 : z)) continue;
        ++by_slice[static_cast<std::size_t>(z)];
        if (z >= z_begin && z < z_end) ++by_column[static_cast<std::size_t>(y * grid.frame.size[0] + x)];
      }
  EXPECT_EQ(slices, by_slice);
  EXPECT_EQ(columns, by_column);
}

}  // namespace

TEST(Count, AgreesWithCountingOneByOne) {
  for (const std::array<int, 3> size : {std::array{1, 1, 1}, {64, 3, 9}, {65, 40, 37}, {130, 7, 300}})
    for (const double density : {0.0, 0.5, 1.0}) {
      const VoxelGrid grid = random_grid(size, density, 1), space = random_grid(size, 0.8, 2),
                      slice = random_grid({size[0], size[1], 1}, 0.8, 3);
      check(grid, space, 0, size[2]);
      check(grid, slice, size[2] / 3, size[2]);
      check(grid, grid, 0, size[2] / 2);
    }
}

TEST(Count, IsTheSameForAnyNumberOfThreads) {
  const VoxelGrid grid = random_grid({100, 90, 80}, 0.6, 4);
  set_threads(1);
  const auto columns = column_counts(grid, grid, 3, 77);
  const auto slices = slice_counts(grid);
  for (int threads : {2, 4}) {
    set_threads(threads);
    EXPECT_EQ(column_counts(grid, grid, 3, 77), columns);
    EXPECT_EQ(slice_counts(grid), slices);
  }
  set_threads(1);
}

}  // namespace packbed
