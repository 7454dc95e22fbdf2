// voxels.h5: bit for bit what was written, refused when damaged.
#include "io/grid.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/atomic_file.hpp"
#include "math/error.hpp"
#include "math/random.hpp"
#include "temporary_folder.hpp"

namespace packbed {
namespace {

VoxelGrid random_grid(bool labels) {
  GridFrame frame;
  frame.origin = {-1.5e-3, 0.25, 1e-9};
  frame.pitch = 1.0 / 3;
  frame.size = {70, 9, 5};
  VoxelGrid grid(frame);
  if (labels) grid.labels.assign(70 * 9 * 5, 0);
  Random r(1, Stream::test, 0);
  std::size_t voxel = 0;
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 70; ++x, ++voxel) {
        if (r.uniform() < 0.5) continue;
        grid.words[grid.row(y, z) + static_cast<std::size_t>(x) / 64] |= std::uint64_t{1} << (x % 64);
        if (labels) grid.labels[voxel] = 1 + static_cast<std::int32_t>(voxel);
      }
  grid.doubled = 17;
  return grid;
}

}  // namespace

TEST(GridFile, ComesBackBitForBit) {
  const TemporaryFolder folder;
  for (const bool labels : {false, true}) {
    const VoxelGrid grid = random_grid(labels);
    write_grid((folder / "voxels.h5"), grid, {0.02225, 3.93e-3, "a test"});
    EXPECT_TRUE(is_grid_file((folder / "voxels.h5")));
    for (const std::string& path : {(folder / "voxels.h5"), folder.path()}) {
      const GridFile back = read_grid(path);
      EXPECT_EQ(back.grid.words, grid.words);
      EXPECT_EQ(back.grid.labels, grid.labels);
      EXPECT_EQ(back.grid.doubled, 17);
      EXPECT_EQ(back.grid.frame.origin, grid.frame.origin);
      EXPECT_EQ(back.grid.frame.pitch, grid.frame.pitch);
      EXPECT_EQ(back.grid.frame.size, grid.frame.size);
      EXPECT_EQ(back.note.container_radius, 0.02225);
      EXPECT_EQ(back.note.diameter, 3.93e-3);
      EXPECT_EQ(back.note.source, "a test");
    }
  }
}

TEST(GridFile, ACutOrChangedFileIsRefused) {
  const TemporaryFolder folder;
  const std::string path = (folder / "voxels.h5");
  write_grid(path, random_grid(false), {});
  const std::string whole = read_file(path);
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, whole.size() / 2, whole.size() - 1}) {
    write_atomically(path, std::string_view(whole).substr(0, length));
    EXPECT_THROW(read_grid(path), InputError) << length;
  }
  std::string changed = whole;
  changed[whole.size() / 2] = static_cast<char>(changed[whole.size() / 2] ^ 1);
  write_atomically(path, changed);
  EXPECT_THROW(read_grid(path), InputError);
  EXPECT_THROW(read_grid((folder / "missing.h5")), InputError);
  EXPECT_FALSE(is_grid_file((folder / "missing.h5")));
}

}  // namespace packbed
