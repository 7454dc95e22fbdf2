// Shared cells against cells and faces looked at one by one.
#include "lattice/shared_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
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
    s.square[3] += c[0] * c[1];
    s.square[4] += c[0] * c[2];
    s.square[5] += c[1] * c[2];
    for (std::size_t d = 0; d < 3; ++d) {
      s.sum[d] += c[d];
      s.square[d] += c[d] * c[d];
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
  EXPECT_EQ(s.square, t.square);
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

/// Mean and root mean square of (depth that cells tell - true depth) of a cylinder of 27 x 18 cells pressed
/// into a plane face by `depth` cells, its axis tilted by `tilt` from the face's normal; any way round.
struct Error {
  double mean = 0, rms = 0;
};
Error depth_error(double tilt, double depth) {
  constexpr int kPoses = 60;
  StampMaker maker(1e-3, 45e-3);
  const ShapePtr body = test::cylinder(27e-3, 18e-3), anvil = test::cylinder(80e-3, 12e-3);
  const double reach = 13.5 * std::sin(tilt) + 9 * std::cos(tilt) - depth;  // of the centre from the face
  Error error;
  for (std::uint32_t i = 0; i < kPoses; ++i) {
    Random random(12, Stream::test, i);
    const Quat turn = random.rotation();
    const Vec3 normal = turn * Vec3::UnitZ();
    const auto phase = [&] { return random.uniform(-0.5, 0.5); };
    const Vec3 phase_b(phase(), phase(), phase());
    const Vec3 centre = phase_b + (6 + reach) * normal;  // of a, from the centre of b's cell
    Cell apart{};
    Vec3 phase_a;
    for (int d = 0; d < 3; ++d) {
      const int cell = static_cast<int>(std::floor(centre[d] + 0.5));
      phase_a[d] = centre[d] - cell;
      // one cell towards b, as digidem looks ahead
      const int lead = std::abs(normal[d]) < 0.38 ? 0 : normal[d] > 0 ? -1 : 1;
      apart[static_cast<std::size_t>(d)] = -(cell + lead);
    }
    const Vec3 ahead(apart[0] + std::floor(centre.x() + 0.5), apart[1] + std::floor(centre.y() + 0.5),
                     apart[2] + std::floor(centre.z() + 0.5));  // the lead, turned round
    const Quat lean = turn * Quat(Eigen::AngleAxisd(tilt, Vec3::UnitX()));
    const SharedCells cells =
        shared_cells(maker.make(*body, 1, lean, phase_a), maker.make(*anvil, 1, turn, phase_b), apart);
    const double told = cells.count ? patch_of(cells, normal).depth - ahead.dot(normal) : 0;
    error.mean += (told - depth) / kPoses;
    error.rms += (told - depth) * (told - depth) / kPoses;
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

// Faces, lines and edges are told as deep as they are, in the mean within a third of a cell; a face that
// leans a little has its mean told rather than its deeper side, which is half a cell less for a tilt of ten
// degrees.
TEST(SharedCells, TellTheDeepestOverlapOfFacesLinesAndEdges) {
  for (const double degrees : {0.0, 2.0, 10.0, 30.0, 45.0, 70.0, 90.0})
    for (const double depth : {0.0, 0.5, 1.0}) {
      const Error e = depth_error(degrees * kPi / 180, depth);
      const bool leans = degrees > 0 && degrees < 20;
      EXPECT_NEAR(e.mean, leans ? -0.25 : 0, 0.35) << degrees << " degrees, depth " << depth;
      EXPECT_LT(e.rms, 0.6) << degrees << " degrees, depth " << depth;
    }
}

}  // namespace
}  // namespace packbed
