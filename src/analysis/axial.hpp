#pragma once
// Packing density over the height, from voxels.
#include "analysis/layout.hpp"

namespace packbed {

/// Solid and inside voxels of each slice (nz).
struct SliceCounts {
  std::vector<std::int64_t> solid, space;
};
SliceCounts count_slices(const VoxelGrid& grid, const VoxelGrid& space);

/// Solid over inside voxels of all slices in a bin; NaN where there is no inside.
std::vector<double> axial_profile(const SliceCounts& counts, const Layout& layout);

}  // namespace packbed
