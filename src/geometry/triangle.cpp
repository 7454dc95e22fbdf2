#include "geometry/triangle.hpp"

#include <algorithm>

namespace packbed {
namespace {

TrianglePoint on_edge(const Vec3& p, const Vec3& from, const Vec3& to, int edge, int corner_from,
                      int corner_to) {
  const Vec3 along = to - from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? (p - from).dot(along) / length2 : 0.0;
  if (t <= 0) return {from, corner_from};
  if (t >= 1) return {to, corner_to};
  return {from + t * along, edge};
}

}  // namespace

TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d11 = ab.squaredNorm(), d12 = ab.dot(ac), d22 = ac.squaredNorm();
  const double d1 = ap.dot(ab), d2 = ap.dot(ac);
  const double area2 = d11 * d22 - d12 * d12;  // four times the squared area
  const double v = d1 * d22 - d2 * d12, w = d2 * d11 - d1 * d12;
  if (area2 > 0 && v > 0 && w > 0 && v + w < area2) return {a + (v / area2) * ab + (w / area2) * ac, 0};
  TrianglePoint best = on_edge(p, a, b, 1, 4, 5);
  double best2 = (p - best.point).squaredNorm();
  for (const TrianglePoint& other : {on_edge(p, b, c, 2, 5, 6), on_edge(p, c, a, 3, 6, 4)}) {
    const double other2 = (p - other.point).squaredNorm();
    if (other2 < best2) best = other, best2 = other2;
  }
  return best;
}

}  // namespace packbed
