#pragma once
// Volume of pellets below a height, without voxels: closed forms for sphere and cylinder, and for any closed
// mesh.
#include <vector>

#include "bed/packed_bed.hpp"

namespace packbed {

/// Volume of a pellet below the plane at height z [m3].
double volume_below(const Shape& shape, const Pellet& pellet, double z);

/// Volume of all pellets between each edge and the next [m3] (edges - 1). What lies in two pellets counts
/// twice, and what reaches through the wall counts.
std::vector<double> slab_volumes(const PackedBed& bed, const std::vector<double>& edges);

}  // namespace packbed
