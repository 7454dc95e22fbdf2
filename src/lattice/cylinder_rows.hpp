#pragma once
// A cylinder as intervals of x, row by row, in closed form: a row meets its side where a quadratic form is
// not positive and its caps where |a . r| <= h.
#include <cstdint>
#include <vector>

#include "math/types.hpp"

namespace packbed {

/// Rows of cells that a cylinder may reach.
struct RowBox {
  int y = 0, ny = 0;  // first row, number of rows
  int z = 0, nz = 0;  // first slice, number of slices
};

/// The cells of a body that each row meets in one interval.
struct RowIntervals {
  static constexpr int kLane = 16, kMore = 8;  // rows that are worked on at a time; empty rows after them
  RowBox box;
  std::vector<std::int32_t> from, to;  // (nz, stride): cells [from, to) of x, 0 and 0 where the row misses
  /// Rows of a slice, some beyond the box included, so that eight may be read from any of its rows.
  int stride() const { return (box.ny + kLane - 1) / kLane * kLane + kMore; }
  std::size_t at(int k) const { return static_cast<std::size_t>(k) * static_cast<std::size_t>(stride()); }
};

/// Half the box of a cylinder along a unit vector, along x, y, z.
Vec3 reach_of_cylinder(const Vec3& axis, double radius, double half_height);

/// Cells whose centres (whole numbers) lie in the cylinder round `centre` along the unit vector `axis`; all
/// lengths in cells; x from 0 to `length`, cells beyond are left out. `out.box` is given.
void cylinder_intervals(const Vec3& centre, const Vec3& axis, double radius, double half_height, int length,
                        RowIntervals& out);

}  // namespace packbed
