#pragma once
// Where a pellet may be at the start: inside the container, clear of the others.
#include <span>
#include <string>
#include <vector>

#include "bed/scene.hpp"
#include "packers/overlap_test.hpp"

namespace packbed {

/// Farthest point of a pellet from the z axis [m], exact for spheres and cylinders, of the vertices for
/// meshes.
double radial_extent(const Shape& shape, double scale, const Pose& pose);
/// Lowest point of a pellet [m].
double lowest_point(const Shape& shape, double scale, const Pose& pose);
/// Whether a sphere lies wholly inside the container, above its floor and clear of its wall. Free space holds
/// everything; a tube has no lid and no end above its rim.
bool sphere_inside(const Container& container, const Vec3& centre, double radius);

/// Throws InputError, naming ids, when placed pellets overlap one another (unless both are fixed) or the
/// container by more than the scene allows: the larger of the contact's allowed overlap and the audit's
/// limit.
void check_placed(const Scene& scene, const OverlapTest& test, std::span<const Pellet> pellets);

}  // namespace packbed
