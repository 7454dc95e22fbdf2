#pragma once
// A solid cylinder where it is, and the depth of a point in it.
//
// The depth of a point in a cylinder of radius R and half height h, at distance rho from the axis and height
// z:
//     a = (R^2 - rho^2) / 2R,   b = (h^2 - z^2) / 2h,   depth = a + b - (a^4 + b^4)^(1/4)   for a, b > 0
// It is smooth inside, never larger than the nearer of the two distances, and of unit slope at the surface
// (Rvachev's R-function).
//
// Where two edges cross, an arc is as short as it is deep, and the depth of a point near an edge is less than
// that of the edge: the touch would be five times softer than others. There an arc counts for more than its
// length: 1 + kEdgeWeight sin^2 (rho^2 z^2 / R^2 h^2)^kEdgeSharpness times, with the angle between the axes,
// so that caps that lie on one another keep their stiffness.
#include "math/types.hpp"

namespace packbed {

/// A cylinder where it is.
struct Rod {
  Vec3 centre;             // [m]
  Vec3 axis;               // unit
  double radius = 0;       // [m]
  double half_height = 0;  // [m]
};

/// Largest separation over a few directions: a lower bound of the distance, negative where none separates
/// [m].
double separation(const Rod& a, const Rod& b);

inline constexpr double kEdgeWeight = 1000;
inline constexpr int kEdgeSharpness = 16;

/// Depth and its slope at x, relative to the centre of the cylinder; 0 outside.
double depth_in_cylinder(const Vec3& x, const Vec3& axis, double radius, double half_height, Vec3& slope);
/// What a point counts for beyond its length near the edge, per sine squared of the angle between the axes,
/// and its slope at x, relative to the centre.
double more_at_edge(const Vec3& x, const Vec3& axis, double radius, double half_height, Vec3& slope);

}  // namespace packbed
