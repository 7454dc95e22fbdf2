#pragma once
// Points on a body's surface that stand for it in a touch, each with a weight [m]. The weights are the three
// curvature measures of the body (Steiner 1840), made lengths by its size R:
//
//   faces     area / R, and more where the surface is curved: kCurved (k1 + k2) area
//   edges     kEdge x length x turning angle (sharp convex edges only)
//   corners   kCorner x R x missing angle
//
// so that the p-norm of the depth (contact/touch.hpp) is about as stiff for a ball or an edge as for a flat
// face, whatever the triangles of the mesh are like. docs/field_kernel.md has the measurements.
#include <cstdint>
#include <vector>

#include "shape/shape.hpp"

namespace packbed {

inline constexpr double kCurved = 6;      // a crossing of two sides within a factor 3 of a flat touch
inline constexpr double kEdge = 2 / kPi;  // a right-angled edge counts with its length
inline constexpr double kCorner = 0.3;    // a corner of a box counts with half of R
// Of the spacing on faces. Two edges that cross meet over a length of about their depth, and are not seen
// before that reaches a third of the spacing of their points: 0.08 % of the diameter of the sphere of equal
// volume.
inline constexpr double kEdgeSpacing = 1.0 / 16;
/// The diameter of that sphere over the spacing of the points on flat faces.
inline constexpr double kPointsAcross = 14;
/// Curved faces have theirs so much closer that no place between two bulges out farther than this, fraction
/// of the body's smallest thickness, in either direction; but no closer than kClosest spacings.
inline constexpr double kBulge = 1e-3, kClosest = 1.0 / 3;
inline constexpr std::size_t kCluster = 16;

/// Points in clusters of kCluster that lie next to each other (the last is filled up with weight 0).
struct SurfacePoints {
  std::vector<double> x, y, z;                                          // in the shape's frame [m]
  std::vector<double> weight;                                           // [m]
  std::vector<double> cluster_x, cluster_y, cluster_z, cluster_radius;  // spheres that hold them [m]
  double cover = 0;  // no point of the surface is farther than this from one of these [m]
  std::size_t clusters() const { return cluster_x.size(); }
  std::size_t size() const { return x.size(); }
};

/// `spacing` between neighbouring points on flat faces [m]; kEdgeSpacing of it on edges; less on curved
/// faces, whose bulges shrink with its square. From the exact surface of spheres and cylinders, else from the
/// triangles. The same for the same shape, always.
SurfacePoints sample_surface(const Shape& shape, double spacing);

/// Radius that makes areas lengths: of a sphere or cylinder its own, of a mesh that of the sphere of the same
/// volume [m].
double size_radius(const Shape& shape);

}  // namespace packbed
