#include "lattice/shared_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace packbed {
namespace {

/// Adds one word of shared cells; a and b give bits of either body round it, (x, y, z) counted from a's box.
template <class A, class B>
void add_word(std::uint64_t both, int x, int y, int z, const Cell& low, const A& a, const B& b,
              SharedCells& s) {
  const std::int64_t n = std::popcount(both);
  std::int64_t within = 0, square = 0;  // sums of the bits' numbers and of their squares
  for (std::uint64_t bits = both; bits; bits &= bits - 1) {
    const std::int64_t i = std::countr_zero(bits);
    within += i;
    square += i * i;
  }
  const std::int64_t x0 = low[0] + x, cy = low[1] + y, cz = low[2] + z, sum_x = within + n * x0;
  s.count += n;
  s.sum[0] += sum_x;
  s.sum[1] += n * cy;
  s.sum[2] += n * cz;
  s.square[0] += square + 2 * x0 * within + n * x0 * x0;
  s.square[1] += n * cy * cy;
  s.square[2] += n * cz * cz;
  s.square[3] += sum_x * cy;
  s.square[4] += sum_x * cz;
  s.square[5] += n * cy * cz;
  // a face of b looks along +x where its neighbour there is not b's; likewise for a, with the other sign
  const auto faces = [&](int dx, int dy, int dz) {
    return static_cast<std::int64_t>(std::popcount(both & ~b(x + dx, y + dy, z + dz))) -
           static_cast<std::int64_t>(std::popcount(both & ~a(x + dx, y + dy, z + dz)));
  };
  s.area[0] += faces(1, 0, 0) - faces(-1, 0, 0);
  s.area[1] += faces(0, 1, 0) - faces(0, -1, 0);
  s.area[2] += faces(0, 0, 1) - faces(0, 0, -1);
}

}  // namespace

namespace {

/// Variance along the normal of what a plane fitted to the cells leaves: the faces of few cells tell the
/// normal badly, and a wide flat patch seen askew would look thick.
double thickness_squared(const Mat3& spread, const Vec3& normal) {
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 s = normal.cross(Vec3::Unit(least)).normalized(), t = normal.cross(s);
  constexpr double kCell = 1.0 / 12;  // of one cell's own extent: a single row of cells has no plane
  const Vec3 along = spread * normal;
  const double a = s.dot(spread * s) + kCell, b = s.dot(spread * t), c = t.dot(spread * t) + kCell;
  const double x = s.dot(along), y = t.dot(along);
  return normal.dot(along) - (c * x * x - 2 * b * x * y + a * y * y) / (a * c - b * b);
}

}  // namespace

Patch patch_of(const SharedCells& cells, const Vec3& guess) {
  Patch patch;
  const double n = static_cast<double>(cells.count);
  Vec3 area;
  for (int d = 0; d < 3; ++d) {
    area[d] = 0.5 * static_cast<double>(cells.area[static_cast<std::size_t>(d)]);
    patch.point[d] = static_cast<double>(cells.sum[static_cast<std::size_t>(d)]) / n;
  }
  patch.area = area.norm();
  patch.normal = patch.area < 0.5 ? guess : Vec3(area / patch.area);
  const auto& q = cells.square;
  Mat3 spread;  // covariance of the cells' centres
  const std::array<std::array<std::size_t, 3>, 3> place{{{0, 3, 4}, {3, 1, 5}, {4, 5, 2}}};
  for (int d = 0; d < 3; ++d)
    for (int e = 0; e < 3; ++e)
      spread(d, e) =
          static_cast<double>(q[place[static_cast<std::size_t>(d)][static_cast<std::size_t>(e)]]) / n -
          patch.point[d] * patch.point[e];
  const double thick = std::sqrt(std::max(0.0, thickness_squared(spread, patch.normal)));
  // Mean depth and thickness over the deepest are 1 and 1 / sqrt(12) for a flat touch, 0.75 and 0.26 for the
  // side of a cylinder, 0.5 to 0.6 and 0.18 to 0.21 for its rim (measured over tilts and turns): exact for
  // the first, within a third of a cell for the others (test SharedCells.TellTheDeepest*)
  constexpr double kOfThick = 7.3, kOfMean = 1 - kOfThick / 3.4641;
  // faces that cancel leave little area; no body of so little thickness is deeper than this in the mean
  const double mean = std::min(n / std::max(patch.area, 1.0), 1 + std::sqrt(12.0) * thick);
  patch.depth = std::clamp(kOfThick * thick + kOfMean * mean, mean, 3 * mean);
  return patch;
}

SharedCells shared_cells(const Stamp& a, const Stamp& b, const Cell& apart) {
  SharedCells s;
  Cell shift{};  // b's box as a's box counts
  int low[3], high[3];
  for (std::size_t d = 0; d < 3; ++d) {
    shift[d] = apart[d] + b.low[d] - a.low[d];
    low[d] = std::max(1, shift[d] + 1);  // the borders are empty
    high[d] = std::min(a.size[d], shift[d] + b.size[d]) - 1;
    if (low[d] >= high[d]) return s;
  }
  const auto bits_a = [&](int x, int y, int z) { return box_bits(a, x, y, z); };
  const auto bits_b = [&](int x, int y, int z) {
    return box_bits(b, x - shift[0], y - shift[1], z - shift[2]);
  };
  for (int z = low[2]; z < high[2]; ++z)
    for (int w = 0; w < a.words; ++w) {
      const std::uint64_t* row =
          a.data() + static_cast<std::size_t>(z) * a.slice() + static_cast<std::size_t>(w) * a.column();
      for (int y = low[1]; y < high[1]; ++y) {
        if (!row[y]) continue;
        if (const std::uint64_t both = row[y] & bits_b(64 * w, y, z))
          add_word(both, 64 * w, y, z, a.low, bits_a, bits_b, s);
      }
    }
  return s;
}

SharedCells shared_cells(const Stamp& a, const Occupancy& lattice, const Cell& at, int z_begin, int z_end) {
  SharedCells s;
  const auto bits_a = [&](int x, int y, int z) { return box_bits(a, x, y, z); };
  const Cell base{at[0] + a.low[0], at[1] + a.low[1], at[2] + a.low[2]};
  const auto bits_b = [&](int x, int y, int z) {
    return lattice.taken_from(base[0] + x, base[1] + y, base[2] + z);
  };
  const int low = std::max(1, z_begin - base[2]), high = std::min(a.size[2] - 1, z_end - base[2]);
  for (int z = low; z < high; ++z)
    for (int w = 0; w < a.words; ++w) {
      const std::uint64_t* row =
          a.data() + static_cast<std::size_t>(z) * a.slice() + static_cast<std::size_t>(w) * a.column();
      for (int y = 1; y < a.size[1] - 1; ++y) {
        if (!row[y]) continue;
        if (const std::uint64_t both = row[y] & bits_b(64 * w, y, z))
          add_word(both, 64 * w, y, z, a.low, bits_a, bits_b, s);
      }
    }
  return s;
}

}  // namespace packbed
