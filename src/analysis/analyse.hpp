#pragma once
// What a bed or a grid is like: the one entry to all analyses (docs/analysis.md).
#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"
#include "bed/scene.hpp"
#include "lattice/voxel_grid.hpp"

namespace packbed {

/// All that the wish asks for. Voxels are made when wish.voxels is set; `grid`, when given, receives them. A
/// grid of this bed that is there already, in the frame that frame_for(bed, wish.voxel) gives, is taken as it
/// is. Without voxels the profiles hold the exact curves only. Throws InputError for a pitch that cannot be.
AnalysisResult analyse_bed(const PackedBed& bed, const AnalysisWish& wish, VoxelGrid* grid = nullptr);

/// Profiles of a grid that came from elsewhere (a CT volume, a lattice packer), inside an upright tube of
/// `container_radius` [m] round the z axis (0: the whole grid is inside). wish.diameter must be positive: a
/// grid does not know its pellets; InputError otherwise. Orientation, overlap and exact curves need poses and
/// stay empty.
AnalysisResult analyse_grid(const VoxelGrid& grid, double container_radius, const AnalysisWish& wish);

}  // namespace packbed
