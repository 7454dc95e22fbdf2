#pragma once
// How far a pellet reaches: exact for spheres and cylinders, by vertices for meshes.
#include "bed/packed_bed.hpp"

namespace packbed {

/// Largest value of direction . x over the pellet's points x [m], for a unit direction in world axes.
double reach(const Shape& shape, const Pellet& pellet, const Vec3& direction);
/// Smallest upright box round a pellet, world axes [m].
Box3 bounding_box(const Shape& shape, const Pellet& pellet);
/// Smallest upright box round all pellets [m]; empty for an empty bed.
Box3 bounding_box(const PackedBed& bed);

}  // namespace packbed
