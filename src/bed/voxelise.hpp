#pragma once
// Bed to grid, by the centroid rule (see lattice/rasterise.hpp): a voxel is solid when its centre lies in a
// pellet.
#include "bed/packed_bed.hpp"
#include "lattice/voxel_grid.hpp"

namespace packbed {

/// Grid round the inside of a container from the floor (z = 0) up to `top` [m], symmetric about the axis.
/// Box: its inner sides. Tube: its inner diameter (LC, 44.5 mm, at 0.1 mm and 120 mm: 445 x 445 x 1200).
/// Mesh: its whole wall and one voxel more all round, so that the outside can be told from the inside. Throws
/// InputError for a pitch that is not positive, that is coarser than the container or that needs more than
/// 2^37 voxels, and for a container without sides (plane, none).
GridFrame frame_for(const Container& container, double pitch, double top);
/// The same for a bed up to its highest pellet; without sides: the box of its pellets (plane: down to the
/// floor).
GridFrame frame_for(const PackedBed& bed, double pitch);

/// Solid voxels of all pellets (the container is not drawn). With `labels`, a voxel that two pellets cover
/// keeps the one that comes first in the bed. Identical for any number of threads.
VoxelGrid voxelise(const PackedBed& bed, const GridFrame& frame, bool labels = false);

/// Along the edge of a voxel of partial_volume.
inline constexpr int kMostPoints = 32;
/// Fraction of each voxel inside pellets from k^3 points (1 <= k <= kMostPoints): float (nz, ny, nx). Points
/// in two pellets count once. The error falls with the fineness pitch / k.
std::vector<float> partial_volume(const PackedBed& bed, const GridFrame& frame, int k);

/// Voxels that belong to the inside of the container. One slice that stands for all where they are alike
/// (frame.size[2] == 1): tube (centre within the radius), box (within the sides), plane and none (all). Mesh:
/// neither wall nor reached from the edge of the slice by steps along x and y; a slice whose wall has a gap
/// has no inside.
VoxelGrid container_space(const Container& container, const GridFrame& frame);

}  // namespace packbed
