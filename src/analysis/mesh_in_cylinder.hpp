#pragma once
// Volume of a closed mesh inside an upright cylinder, exact: part of exact_radial.hpp.
#include <vector>

#include "bed/packed_bed.hpp"

namespace packbed {

/// Adds to `bins` (radii - 1) the volume of a posed closed mesh between each radius and the next and between
/// two heights [m3].
void add_mesh_rings(const TriangleMesh& surface, const Pellet& pellet, const std::vector<double>& radii,
                    double z_low, double z_high, std::vector<double>& bins);

}  // namespace packbed
