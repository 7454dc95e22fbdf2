// Shared cells against cells and faces looked at one by one.
#include "lattice/shared_cells.hpp"

#include <gtest/gtest.h>

#include <set>

#include "../shapes.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

constexpr double kPitch = 1e-4;

std::set<Cell> cells_of(const Stamp& stamp, const Cell& at) {
  std::set<Cell> cells;
  for_each_cell(stamp, [&](int x, int y, int z) { cells.insert({at[0] + x, at[1] + y, at[2] + z}); });
  return cells;
}

template <class Taken>
SharedCells by_hand(const std::set<Cell>& a, const Taken& in_b) {
  SharedCells s;
  for (const Cell& c : a) {
    if (!in_b(c)) continue;
    ++s.count;
    for (std::size_t d = 0; d < 3; ++d) {
      s.sum[d] += c[d];
      for (const int sign : {1, -1}) {
        Cell next = c;
        next[d] += sign;
        s.area[d] += sign * (!in_b(next) - !a.count(next));
      }
    }
  }
  return s;
}

void expect_same(const SharedCells& s, const SharedCells& t) {
  EXPECT_EQ(s.count, t.count);
  EXPECT_EQ(s.sum, t.sum);
  EXPECT_EQ(s.area, t.area);
}

TEST(SharedCells, OfTwoPelletsAgreeWithCellsOneByOne) {
  StampMaker maker(kPitch, 6e-3);
  int met = 0;
  for (std::uint32_t i = 0; i < 40; ++i) {
    Random random(8, Stream::test, i);
    const auto stamp = [&](double most) {
      return maker.make(*test::cylinder(random.uniform(1e-3, most), random.uniform(1e-3, most)), 1,
                        random.rotation(), Vec3::Zero());
    };
    const Stamp a = stamp(i < 5 ? 6e-3 : 2e-3), b = stamp(2e-3);  // the first are wider than a word
    const auto go = [&] { return static_cast<int>(random.uniform(-14, 14)); };
    const Cell apart{go(), go(), go()};
    const auto cells_b = cells_of(b, apart);
    const SharedCells s = shared_cells(a, b, apart);
    expect_same(s, by_hand(cells_of(a, {0, 0, 0}), [&](const Cell& c) { return cells_b.count(c) > 0; }));
    met += s.count > 0;
  }
  EXPECT_GT(met, 10);
}

TEST(SharedCells, WithTheContainerAgreeWithCellsOneByOne) {
  GridFrame frame;
  frame.pitch = kPitch;
  frame.size = {70, 60, 50};
  GridFrame slice = frame;
  slice.size[2] = 1;
  VoxelGrid space(slice);
  for (int y = 5; y < 60; ++y)
    space.words[space.row(y, 0)] = ~std::uint64_t{0};  // 64 of 70 columns, 55 of 60 rows
  const Occupancy lattice(frame, space);
  StampMaker maker(kPitch, 2e-3);
  for (std::uint32_t i = 0; i < 20; ++i) {
    Random random(9, Stream::test, i);
    const Stamp a = maker.make(*test::cylinder(2e-3, 1.5e-3), 1, random.rotation(), Vec3::Zero());
    const Cell at{static_cast<int>(random.uniform(0, 70)), static_cast<int>(random.uniform(0, 60)),
                  static_cast<int>(random.uniform(0, 50))};
    const Cell origin{0, 0, 0};
    const auto taken = [&](const Cell& c) {
      return lattice.taken({c[0] + at[0], c[1] + at[1], c[2] + at[2]});
    };
    const SharedCells all = shared_cells(a, lattice, at, -1000, 1000);
    expect_same(all, by_hand(cells_of(a, origin), taken));
    const SharedCells floor = shared_cells(a, lattice, at, -1000, 0),
                      side = shared_cells(a, lattice, at, 0, 1000);
    EXPECT_EQ(floor.count + side.count, all.count);
  }
}

}  // namespace
}  // namespace packbed
