#pragma once
// Counting the bits of a grid.
#include <cstdint>
#include <vector>

#include "lattice/voxel_grid.hpp"

namespace packbed {

/// Solid voxels of each slice that also lie in `space` (nz). `space` has the slices of the grid, or one that
/// stands for all of them.
std::vector<std::int64_t> slice_counts(const VoxelGrid& grid, const VoxelGrid& space);
/// All solid voxels of each slice (nz).
std::vector<std::int64_t> slice_counts(const VoxelGrid& grid);

/// For each column (x, y): solid voxels in slices [z_begin, z_end) that also lie in `space` (ny, nx).
std::vector<std::int32_t> column_counts(const VoxelGrid& grid, const VoxelGrid& space, int z_begin,
                                        int z_end);

}  // namespace packbed
