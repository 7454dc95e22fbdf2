// The copy of the lattice round a pellet, the probes that look into it and the core that tells their inside,
// against cells one by one.
#include "lattice/surroundings.hpp"

#include <gtest/gtest.h>

#include <set>

#include "../shapes.hpp"
#include "lattice/probes.hpp"
#include "math/random.hpp"
#include "mesh/inside.hpp"

namespace packbed {
namespace {

constexpr double kPitch = 1e-4;

Cell sum(const Cell& a, const Cell& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// A tube's lattice with some cylinders anywhere in it.
Occupancy crowded(Random& random, StampMaker& maker) {
  GridFrame frame;
  frame.pitch = kPitch;
  frame.size = {150, 90, 120};
  GridFrame slice = frame;
  slice.size[2] = 1;
  VoxelGrid space(slice);
  for (int y = 0; y < slice.size[1]; ++y)
    for (int x = 0; x < slice.size[0]; ++x)
      if (random.uniform() < 0.98)
        space.words[space.row(y, 0) + static_cast<std::size_t>(x) / 64] |= std::uint64_t{1} << (x % 64);
  Occupancy lattice(frame, space);
  for (int k = 0; k < 6; ++k) {
    const Stamp stamp = maker.make(*test::cylinder(2e-3, 2e-3), 1, random.rotation(), Vec3::Zero());
    lattice.write(
        stamp, {25 + static_cast<int>(random.uniform() * 100), 25 + static_cast<int>(random.uniform() * 40),
                25 + static_cast<int>(random.uniform() * 70)});
  }
  return lattice;
}

TEST(Surroundings, AreTheLatticeWithoutThePellet) {
  StampMaker maker(kPitch, 6e-3);
  int rows = 0, beyond = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    Random random(8, Stream::test, i);
    Occupancy lattice = crowded(random, maker);
    const auto shape =
        test::cylinder(random.uniform(1e-3, 5e-3), random.uniform(1e-3, 5e-3));  // to two words wide
    const Stamp stamp = maker.make(*shape, 1, random.rotation(), Vec3(0.2, -0.4, 0.1));
    // near the edges too, where the copy reaches out of the lattice
    Cell at{};
    for (std::size_t d = 0; d < 3; ++d) at[d] = static_cast<int>(random.uniform() * lattice.frame().size[d]);
    bool inside = true;
    for (std::size_t d = 0; d < 3; ++d)
      inside = inside && at[d] + stamp.low[d] >= -1 &&
               at[d] + stamp.low[d] + stamp.size[d] <= lattice.frame().size[d] + 1;
    if (!inside) continue;
    for_each_cell(stamp, [&](int x, int y, int z) {  // room for it
      const Cell c = sum(at, {x, y, z});
      Stamp dot =
          stamp_of({.word = 0, .words = 1, .y = 0, .ny = 1, .z = 0, .nz = 1, .count = 1, .bits = {1}}, 0);
      if (lattice.taken(c)) lattice.flip(dot, c);
    });
    const Occupancy without = lattice;
    lattice.flip(stamp, at);
    int reach = 0;
    for (std::size_t d = 0; d < 3; ++d)
      reach = std::max({reach, 3 - stamp.low[d], stamp.low[d] + stamp.size[d] + 3});
    Surroundings around;
    around.look(lattice, stamp, at, reach);
    Hits hits;
    for (int k = 0; k < 20; ++k) {
      Cell moved{};
      for (int& m : moved) m = static_cast<int>(random.uniform() * 7) - 3;
      std::set<Cell> expected, found;
      for_each_cell(stamp, [&](int x, int y, int z) {
        if (without.taken(sum(sum(at, moved), {x, y, z}))) expected.insert({x, y, z});
      });
      EXPECT_EQ(around.hits(stamp, moved), !expected.empty());
      EXPECT_EQ(around.list_hits(stamp, moved, hits), !expected.empty());
      for (const HitRow& row : hits.rows())
        for (int b = 0; b < 64; ++b)
          if (row.bits >> b & 1U)
            found.insert(
                {stamp.low[0] + 64 * row.word + b, stamp.low[1] + row.row, stamp.low[2] + row.slice});
      EXPECT_EQ(found, expected);
      rows += static_cast<int>(hits.rows().size());
      const Cell cell{moved[0] * 5, moved[1] * 4, moved[2] * 6};
      if (std::max({std::abs(cell[0]), std::abs(cell[1]), std::abs(cell[2])}) <= reach) {
        EXPECT_EQ(around.taken(cell), without.taken(sum(at, cell)));
      } else {
        EXPECT_TRUE(around.taken(cell));
        ++beyond;
      }
    }
    EXPECT_TRUE(around.hits(stamp, {4 + reach, 0, 0}));
  }
  EXPECT_GT(rows, 1000);
  EXPECT_GT(beyond, 5);
}

/// A ring whose inside no formula tells.
ShapePtr faceted_ring() {
  const ShapePtr ring = make_ring("ring", 4e-3, 3e-3, 2e-3);
  return make_shape("faceted ring", "", ring->surface, false);
}

TEST(Core, LiesWhollyInside) {
  const ShapePtr shape = faceted_ring();
  const double pitch = 5e-5;
  const Core core(shape->surface, shape->bounding_radius, pitch);
  const MeshQuery query(shape->surface);
  Random random(5, Stream::test, 0);
  int held = 0, solid = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 place = shape->bounding_radius * random.uniform(0.0, 1.0) * random.on_sphere();
    const Vec3 cells = place / pitch;
    const bool in = query.inside(place);
    solid += in;
    if (!core.holds(cells.x(), cells.y(), cells.z())) continue;
    ++held;
    EXPECT_TRUE(in) << place.transpose();
  }
  // of a wall of ten cells, some eight
  EXPECT_GT(held, 0.7 * solid);
  EXPECT_LT(held, 0.9 * solid);
}

TEST(Probes, AreCellsOfThePellet) {
  StampMaker maker(kPitch, 4e-3);
  for (const ShapePtr& shape :
       {ShapePtr(test::cylinder(2.7e-3, 1.8e-3)), make_ring("ring", 4e-3, 3e-3, 2e-3), faceted_ring()}) {
    const Probes probes(*shape, kPitch);
    for (std::uint32_t i = 0; i < 300; ++i) {
      Random random(9, Stream::test, i);
      const double scale = random.uniform(0.7, 1.3);
      const Quat rotation = random.rotation();
      const Vec3 phase = StampMaker::first_phase();
      const Stamp stamp = maker.make(*shape, scale, rotation, phase);
      int seen = 0;
      const auto look = [&](const Cell& c) {
        ++seen;
        EXPECT_TRUE(has_cell(stamp, c));
        return false;
      };
      std::uint8_t first = 3;
      EXPECT_FALSE(probes.meet(scale, rotation, phase, first, look));
      EXPECT_EQ(first, 3);
      EXPECT_GT(seen, 40);  // of some hundred points; the cells of the others have their centres outside
      EXPECT_TRUE(probes.meet(scale, rotation, phase, first, [](const Cell&) { return true; }));
      Cell met{};  // what was met is asked first the next time, and all others are asked as well
      int asked = 0;
      const auto last = [&](const Cell& c) { return met = c, ++asked == seen; };
      EXPECT_TRUE(probes.meet(scale, rotation, phase, first, last));
      const Cell before = met;
      bool again = false;
      asked = 0;
      EXPECT_TRUE(probes.meet(scale, rotation, phase, first,
                              [&](const Cell& c) { return again = c == before, ++asked, again; }));
      EXPECT_LE(asked, 8);
    }
  }
}

TEST(Probes, ThereAreNoneOfSpheres) {
  const Probes probes(*test::sphere(3e-3), kPitch);
  std::uint8_t first = 0;
  EXPECT_FALSE(probes.meet(1, Quat::Identity(), Vec3::Zero(), first, [](const Cell&) { return true; }));
}

}  // namespace
}  // namespace packbed
