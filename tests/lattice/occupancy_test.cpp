// The words of the lattice against cells looked at one by one.
#include "lattice/occupancy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../shapes.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

constexpr double kPitch = 1e-4;

GridFrame box(int nx, int ny, int nz) {
  GridFrame frame;
  frame.pitch = kPitch;
  frame.size = {nx, ny, nz};
  return frame;
}

VoxelGrid all_open(const GridFrame& frame) {
  GridFrame slice = frame;
  slice.size[2] = 1;
  VoxelGrid space(slice);
  for (int y = 0; y < slice.size[1]; ++y)
    for (int x = 0; x < slice.size[0]; ++x)
      space.words[space.row(y, 0) + static_cast<std::size_t>(x) / 64] |= std::uint64_t{1} << (x % 64);
  return space;
}

std::size_t index(const Cell& c, const GridFrame& frame) {
  return static_cast<std::size_t>((c[2] * frame.size[1] + c[1]) * frame.size[0] + c[0]);
}

bool within(const Cell& c, const GridFrame& frame) {
  for (std::size_t d = 0; d < 3; ++d)
    if (c[d] < 0 || c[d] >= frame.size[d]) return false;
  return true;
}

/// Cells of a frame that pellets have been drawn in, one by one.
struct Drawn {
  explicit Drawn(const GridFrame& f) : frame(f), cell(index({0, 0, f.size[2]}, f), 0) {}
  void draw(const Stamp& stamp, const Cell& at) {
    for_each_cell(stamp, [&](int x, int y, int z) {
      const Cell c{at[0] + x, at[1] + y, at[2] + z};
      ASSERT_TRUE(within(c, frame));
      cell[index(c, frame)] = 1;
    });
  }
  bool meets(const Stamp& stamp, const Cell& at) const {
    bool met = false;
    for_each_cell(stamp, [&](int x, int y, int z) {
      const Cell c{at[0] + x, at[1] + y, at[2] + z};
      met = met || !within(c, frame) || cell[index(c, frame)];
    });
    return met;
  }
  GridFrame frame;
  std::vector<char> cell;
};

struct Pair {
  Stamp fixed, moving;
  Cell at_fixed, at;
};

/// Cylinders of 1 to 6 mm: from a few cells to two words wide.
Pair random_pair(Random& random, const GridFrame& frame, StampMaker& maker) {
  const auto stamp = [&] {
    const auto shape = test::cylinder(random.uniform(1e-3, 6e-3), random.uniform(1e-3, 6e-3));
    return maker.make(*shape, 1, random.rotation(),
                      Vec3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)));
  };
  const auto place = [&](const Stamp& s) {
    Cell c{};
    for (std::size_t d = 0; d < 3; ++d) {
      const int low = 1 - s.low[d], room = frame.size[d] - s.size[d];
      c[d] = low - 2 + static_cast<int>(random.uniform() * (room + 3));
    }
    return c;
  };
  Pair p;
  p.fixed = stamp();
  p.moving = stamp();
  do p.at_fixed = place(p.fixed);
  while (Drawn(frame).meets(p.fixed, p.at_fixed));
  p.at = place(p.moving);
  return p;
}

TEST(Occupancy, AgreesWithCellsOneByOne) {
  const GridFrame frame = box(140, 100, 100);
  StampMaker maker(kPitch, 6e-3);
  int hits = 0, misses = 0, stopped = 0, went = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    Random random(3, Stream::test, i);
    const Pair p = random_pair(random, frame, maker);
    Occupancy lattice(frame, all_open(frame));
    lattice.flip(p.fixed, p.at_fixed);
    Drawn fixed(frame);
    fixed.draw(p.fixed, p.at_fixed);
    const bool expected = fixed.meets(p.moving, p.at);
    EXPECT_EQ(lattice.hits(p.moving, p.at), expected);
    ++(expected ? hits : misses);
    if (expected) continue;
    lattice.flip(p.moving, p.at);  // the pellet's own cells must not stop it
    Cell at = p.at;
    for (int step = 0; step < 80; ++step) {
      const int axis = static_cast<int>(random.uniform() * 3), sign = random.uniform() < 0.5 ? 1 : -1;
      Cell to = at;
      to[static_cast<std::size_t>(axis)] += sign;
      const bool blocked = fixed.meets(p.moving, to);
      ASSERT_EQ(lattice.hits_on_move(p.moving, at, axis, sign), blocked) << axis << ' ' << sign;
      ++(blocked ? stopped : went);
      if (!blocked) lattice.move(p.moving, at, axis, sign);
    }
    lattice.flip(p.fixed, p.at_fixed);
    lattice.flip(p.moving, at);
    EXPECT_EQ(lattice.shared(p.moving, at), 0);
  }
  EXPECT_GT(hits, 10);
  EXPECT_GT(misses, 10);
  EXPECT_GT(stopped, 100);
  EXPECT_GT(went, 100);
}

TEST(Stamp, OfATubeHasTheCellsWhoseCentresLieInItsWall) {
  const double radius = 2.3e-3, inner = 1.25e-3, half = 2.5e-3;
  const auto ring = make_ring("ring", 2 * radius, 2 * inner, 2 * half);
  StampMaker maker(kPitch, 4e-3);
  for (std::uint32_t i = 0; i < 30; ++i) {
    Random random(11, Stream::test, i);
    const Quat rotation = i == 0 ? Quat::Identity() : random.rotation();
    const Vec3 phase(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
    const Stamp stamp = maker.make(*ring, 1, rotation, phase);
    std::int64_t cells = 0;
    for (int z = -40; z <= 40; ++z)
      for (int y = -40; y <= 40; ++y)
        for (int x = -40; x <= 40; ++x) {
          const Vec3 at = rotation.conjugate() * (kPitch * (Vec3(x, y, z) - phase));
          const double r = at.head<2>().norm();
          const bool inside = std::abs(at.z()) <= half && r <= radius && r > inner;
          cells += inside;
          ASSERT_EQ(has_cell(stamp, {x, y, z}), inside) << x << ' ' << y << ' ' << z;
        }
    EXPECT_EQ(stamp.count, cells);
    GridFrame frame = box(100, 100, 100);
    const Vec3 centre = kPitch * (Vec3(50.5, 50.5, 50.5) + phase);
    Rasteriser rasteriser(frame);
    EXPECT_EQ(rasteriser.body(*ring, {centre, rotation}, 1, 0, 100).count, cells);
  }
}

TEST(Stamp, HasTheCellsThatTheRasteriserGives) {
  const GridFrame frame = box(100, 100, 100);
  StampMaker maker(kPitch, 4e-3);
  for (std::uint32_t i = 0; i < 50; ++i) {
    Random random(4, Stream::test, i);
    const auto shape = test::cylinder(3.42e-3, 3.46e-3);
    const Quat rotation = random.rotation();
    const Vec3 phase(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
    const Cell at{50, 47, 51};
    const Stamp stamp = maker.make(*shape, 1, rotation, phase);
    VoxelGrid grid(frame);
    Rasteriser rasteriser(frame);
    const Vec3 centre = frame.centre(at[0], at[1], at[2]) + kPitch * phase;
    merge(rasteriser.body(*shape, {centre, rotation}, 1, 0, 100), grid, 1);
    Drawn drawn(frame);
    drawn.draw(stamp, at);
    std::int64_t solid = 0;
    for (int z = 0; z < 100; ++z)
      for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) {
          ASSERT_EQ(grid.solid(x, y, z), drawn.cell[index({x, y, z}, frame)] != 0);
          solid += grid.solid(x, y, z);
        }
    EXPECT_EQ(stamp.count, solid);
  }
}

// The paper conserves the volume of cumulatively rotated pixels by a correction; rotating from the shape
// needs none. Pellet of the paper's benchmark: 27 x 27 x 18 cells.
TEST(Stamp, VolumeHoldsOverAHundredThousandRotations) {
  const auto shape = test::cylinder(27 * kPitch, 18 * kPitch);
  StampMaker maker(kPitch, shape->bounding_radius);
  const double exact = shape->volume / std::pow(kPitch, 3);
  double mean = 0, worst = 0;
  constexpr int kRotations = 100000;
  for (std::uint32_t i = 0; i < kRotations; ++i) {
    Vec3 phase;
    const Stamp stamp = maker.make_true(*shape, 1, Random(5, Stream::test, i).rotation(), phase);
    const double off = static_cast<double>(stamp.count) / exact - 1;
    mean += off / kRotations;
    worst = std::max(worst, std::abs(off));
  }
  RecordProperty("mean_percent", std::to_string(100 * mean));
  RecordProperty("worst_percent", std::to_string(100 * worst));
  EXPECT_LT(worst, 0.005);
  EXPECT_LT(std::abs(mean), 0.0002);
}

}  // namespace
}  // namespace packbed
