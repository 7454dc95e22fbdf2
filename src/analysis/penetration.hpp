#pragma once
// How deep two convex bodies dip into each other: the shortest push along one direction that parts them.
#include <optional>

#include "analysis/solid_body.hpp"

namespace packbed {

struct Penetration {
  double depth = 0;            // [m], at most `uncertainty` above the true one
  double uncertainty = 0;      // [m], from a bound on the other side
  Vec3 normal = Vec3::Zero();  // unit, pushes b out of a
  Vec3 point = Vec3::Zero();   // in the overlap, between the two deepest points [m]
};

/// Nothing when the bodies are apart. The bodies must be convex. Depth to 1e-9 of the smaller thickness.
///
/// The difference body {x - y : x in a, y in b} holds the origin when they overlap, and the depth is the
/// distance to its surface. A polytope inside it grows from a tetrahedron: the face nearest to the origin is
/// pushed out to the furthest point of the difference body along its normal, until that gains nothing. Faces
/// bound the depth from below, furthest points from above (after Van den Bergen, Game Developers Conference
/// 2001; here the origin may also start outside the polytope: the first normal along which the furthest point
/// does not reach it ends the search, for then the bodies are apart).
std::optional<Penetration> penetration(const Body& a, const Body& b);

/// Volume that two convex bodies share [m3], from 16 rays round the deepest point in
/// the plane of the touch, four nodes a ray: to a few per cent.
double shared_volume(const Body& a, const Body& b, const Penetration& p);

}  // namespace packbed
