#pragma once
// A pellet as bits, made once a rotation and laid on the lattice at any cell. The bits are the ones of the
// project's rasteriser (centroid rule), moved so that they start at the box's own corner.
//
//   box of cells with one empty cell all round; bits (nz, words, rows): eight rows of y lie side by side, so
//   that one cache line, and one wide register, holds eight of them
#include <array>
#include <cstdint>
#include <vector>

#include "lattice/rasterise.hpp"
#include "lattice/window.hpp"
#include "shape/shape.hpp"

namespace packbed {

using Cell = std::array<int, 3>;  // x, y, z on the lattice

struct Stamp {
  Cell low{0, 0, 0};       // box's corner, counted from the cell that the pellet is in
  Cell size{0, 0, 0};      // cells of the box, its empty border included
  int words = 0;           // 64-bit words along x
  int rows = 0;            // along y, a multiple of eight
  std::int64_t count = 0;  // solid cells
  std::vector<std::uint64_t> bits;
  std::vector<RowRange> ranges;  // one a slice: rows outside have no cells

  static constexpr std::size_t kPad = 8;  // empty words before and after, so that neighbours may be read
  std::size_t column() const { return static_cast<std::size_t>(rows); }
  std::size_t slice() const { return static_cast<std::size_t>(words) * column(); }
  const std::uint64_t* data() const { return bits.data() + kPad; }
  std::uint64_t* data() { return bits.data() + kPad; }
};

/// The bits of a block whose cell `middle`, along each axis, is the pellet's.
Stamp stamp_of(const BitBlock& block, int middle);

/// Makes stamps of one lattice; keeps its memory between calls (one a thread).
class StampMaker {
 public:
  /// `largest`: bounding radius of the largest pellet [m].
  StampMaker(double pitch, double largest);

  /// The pellet with its centre of mass at `phase` [cells] from the centre of its cell. Always rasterised
  /// from the shape itself, so that no number of rotations deforms it.
  Stamp make(const Shape& shape, double scale, const Quat& rotation, const Vec3& phase);

  /// The same with a phase that is chosen so that the number of cells is near the pellet's volume: within
  /// 0.25 % where one of forty gives that, else as near as they come.
  Stamp make_true(const Shape& shape, double scale, const Quat& rotation, Vec3& phase);
  /// The phase that make_true tries first.
  static Vec3 first_phase();

 private:
  Stamp make_cylinder(const Shape& shape, double scale, const Quat& rotation, const Vec3& phase);

  GridFrame frame_;
  RowIntervals rows_, bore_;
  int middle_;  // the pellet's cell in frame_, along each axis
  Rasteriser rasteriser_;
};

/// Corners of a box of cells, the upper one outside.
struct CellBox {
  Cell low, high;
};
/// Of a pellet that lies in the cell `at`, its empty border included.
inline CellBox box_of(const Stamp& stamp, const Cell& at) {
  CellBox box{at, at};
  for (std::size_t d = 0; d < 3; ++d) {
    box.low[d] += stamp.low[d];
    box.high[d] = box.low[d] + stamp.size[d];
  }
  return box;
}

/// Where a stamp lies on a lattice (slices, words, rows) whose first word is `lattice`, when the corner of
/// its box is its cell (x, y, z), none of them negative.
Window window_of(const Stamp& stamp, std::uint64_t* lattice, std::size_t column, std::size_t slice, int x,
                 int y, int z);

/// Whether a cell, counted from the pellet's own, is solid.
inline bool has_cell(const Stamp& stamp, const Cell& cell) {
  std::size_t at[3];
  for (std::size_t d = 0; d < 3; ++d) {
    const int c = cell[d] - stamp.low[d];
    if (c < 0 || c >= stamp.size[d]) return false;
    at[d] = static_cast<std::size_t>(c);
  }
  return (stamp.data()[at[2] * stamp.slice() + at[0] / 64 * stamp.column() + at[1]] >> (at[0] % 64)) & 1U;
}

/// Bits of the 64 cells from (x, y, z) along x, counted from the corner of the box; none outside of it.
inline std::uint64_t box_bits(const Stamp& stamp, int x, int y, int z) {
  if (y < 0 || y >= stamp.size[1] || z < 0 || z >= stamp.size[2]) return 0;
  const std::uint64_t* row =
      stamp.data() + static_cast<std::size_t>(z) * stamp.slice() + static_cast<std::size_t>(y);
  if (stamp.words == 1) return x <= -64 || x >= 64 ? 0 : x < 0 ? *row << -x : *row >> x;
  return bits_from(x, [&](int w) {
    return w < 0 || w >= stamp.words ? std::uint64_t{0} : row[static_cast<std::size_t>(w) * stamp.column()];
  });
}

/// Calls visit(x, y, z) for every solid cell, counted from the pellet's cell, in the order of the bits.
template <class Visit>
void for_each_cell(const Stamp& stamp, const Visit& visit) {
  for (int z = 0; z < stamp.size[2]; ++z)
    for (int w = 0; w < stamp.words; ++w)
      for (int y = 0; y < stamp.size[1]; ++y) {
        std::uint64_t bits =
            stamp.data()[static_cast<std::size_t>(z) * stamp.slice() +
                         static_cast<std::size_t>(w) * stamp.column() + static_cast<std::size_t>(y)];
        for (; bits; bits &= bits - 1)
          visit(stamp.low[0] + 64 * w + __builtin_ctzll(bits), stamp.low[1] + y, stamp.low[2] + z);
      }
}

}  // namespace packbed
