#pragma once
// One triangle: the closest of its points.
#include "math/types.hpp"

namespace packbed {

/// The point of triangle abc closest to p, and on which part of the triangle it lies.
struct TrianglePoint {
  Vec3 point = Vec3::Zero();
  int feature = 0;  // 0: the face; 1, 2, 3: edge ab, bc, ca; 4, 5, 6: corner a, b, c
};

/// After Ericson, Real-Time Collision Detection (2005), section 5.1.5: Voronoi regions of the triangle. A
/// triangle without area gives the closest point of one of its edges.
TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace packbed
