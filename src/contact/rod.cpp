#include "contact/rod.hpp"

#include <algorithm>
#include <cmath>

namespace packbed {
namespace {

double extent(const Rod& rod, const Vec3& direction) {  // half width along a unit vector
  const double along = rod.axis.dot(direction);
  return rod.half_height * std::abs(along) + rod.radius * std::sqrt(std::max(0.0, 1.0 - along * along));
}

}  // namespace

double depth_in_cylinder(const Vec3& x, const Vec3& axis, double radius, double half_height, Vec3& slope) {
  const double z = x.dot(axis);
  const Vec3 rho = x - z * axis;
  const double a = (radius * radius - rho.squaredNorm()) / (2.0 * radius);
  const double b = (half_height * half_height - z * z) / (2.0 * half_height);
  slope.setZero();
  if (!(a > 0 && b > 0)) return 0;
  const double norm = std::sqrt(std::sqrt(a * a * a * a + b * b * b * b)), norm3 = norm * norm * norm;
  slope = -(1.0 - a * a * a / norm3) / radius * rho - ((1.0 - b * b * b / norm3) * z / half_height) * axis;
  return a + b - norm;
}

double more_at_edge(const Vec3& x, const Vec3& axis, double radius, double half_height, Vec3& slope) {
  const double z = x.dot(axis), radius2 = radius * radius, height2 = half_height * half_height;
  const Vec3 rho = x - z * axis;
  const double wide = rho.squaredNorm() / radius2, high = z * z / height2;
  const double near = kEdgeWeight * std::pow(wide * high, kEdgeSharpness - 1);
  slope = 2.0 * kEdgeSharpness * near * (high / radius2 * rho + wide * z / height2 * axis);
  return near * wide * high;
}

double separation(const Rod& a, const Rod& b) {
  const Vec3 w = b.centre - a.centre;
  double best = -1e300;
  const auto try_direction = [&](const Vec3& n, double length2) {
    if (!(length2 > 0)) return;
    const Vec3 unit = n / std::sqrt(length2);
    best = std::max(best, std::abs(w.dot(unit)) - extent(a, unit) - extent(b, unit));
  };
  const Vec3 across = a.axis.cross(b.axis);
  const Vec3 from_a = w - w.dot(a.axis) * a.axis, from_b = w - w.dot(b.axis) * b.axis;
  try_direction(a.axis, 1.0);
  try_direction(b.axis, 1.0);
  try_direction(from_a, from_a.squaredNorm());
  try_direction(from_b, from_b.squaredNorm());
  try_direction(w, w.squaredNorm());
  if (across.squaredNorm() > 1e-10) try_direction(across, across.squaredNorm());
  return best;
}

}  // namespace packbed
