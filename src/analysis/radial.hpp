#pragma once
// Packing density over the distance from a round wall and over the cross-section, from voxels.
#include "analysis/layout.hpp"

namespace packbed {

/// Solid and inside voxels of each column, within the slices of the middle section (ny, nx).
struct ColumnCounts {
  std::vector<std::int32_t> solid, space;
};
ColumnCounts count_columns(const VoxelGrid& grid, const VoxelGrid& space, const Layout& layout);

/// Solid over inside voxels of all columns in a ring; a column that two rings cut counts in both, by
/// sixteenths of its cross-section. A ring weighs by exactly what was counted in it. NaN where there is
/// nothing.
std::vector<double> radial_profile(const ColumnCounts& counts, const Layout& layout);

/// Solid over inside voxels of each column; NaN outside the container.
PlanarMap planar_map(const ColumnCounts& counts, const Layout& layout);

}  // namespace packbed
