#pragma once
// How far pellets reach into the container: part of overlap.hpp.
#include <vector>

#include "analysis/overlap.hpp"
#include "analysis/solid_body.hpp"

namespace packbed {

/// One entry for the wall and one for the floor of each pellet that meets them. bodies: one a pellet of the
/// bed.
std::vector<Overlap> container_overlaps(const PackedBed& bed, const std::vector<Body>& bodies);

}  // namespace packbed
