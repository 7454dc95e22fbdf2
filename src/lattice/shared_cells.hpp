#pragma once
// The cells that two stamps share, or a stamp and what is taken on a lattice: number, place, and the faces
// that bound them. All in whole numbers, so that no order of adding changes anything.
#include <array>
#include <cstdint>

#include "lattice/occupancy.hpp"

namespace packbed {

struct SharedCells {
  std::int64_t count = 0;
  std::array<std::int64_t, 3> sum{0, 0, 0};  // of the cells' coordinates, from the cell that a is in
  std::array<std::int64_t, 6> square{0, 0, 0, 0, 0, 0};  // of xx, yy, zz, xy, xz, yz, from the same cell
  std::array<std::int64_t, 3> area{0, 0, 0};  // faces of b in a less faces of a in b, outward, so that it
                                              // points out of b: the way that a is pushed
};

/// What shared cells tell of the touch. In cells.
struct Patch {
  Vec3 normal = Vec3::Zero();  // of length one, the way that a is pushed; zero when the faces cancel
  Vec3 point = Vec3::Zero();   // mean of the cells, from the centre of the cell that a is in
  double area = 0;             // size of the vector area of the faces of one body in the other
  double depth = 0;            // where it is deepest
};

/// `count` of the cells must not be 0. When the faces cancel, `guess` (of length one) is the normal.
Patch patch_of(const SharedCells& cells, const Vec3& guess);

/// `apart`: the cell of b less the cell of a.
SharedCells shared_cells(const Stamp& a, const Stamp& b, const Cell& apart);
/// Of a stamp in the cell `at` with the taken cells of slices [z_begin, z_end) of a lattice (counted as the
/// lattice's cells; its margin too).
SharedCells shared_cells(const Stamp& a, const Occupancy& lattice, const Cell& at, int z_begin, int z_end);

}  // namespace packbed
