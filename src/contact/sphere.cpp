#include "contact/sphere.hpp"

namespace packbed {
namespace {

/// A touch along the unit normal towards a, whose point is `from_a` from the centre of a and `from_b` from
/// that of b.
Touch along(const Vec3& normal, double delta, const Vec3& point) {
  Touch touch;
  if (!(delta > 0)) return touch;
  touch.delta = touch.depth = delta;
  touch.gradient = normal;
  touch.point = point;
  return touch;
}

}  // namespace

Touch touch_spheres(const Vec3& a, double radius_a, const Vec3& b, double radius_b) {
  const Vec3 apart = a - b;
  const double distance = apart.norm(), delta = radius_a + radius_b - distance;
  if (!(delta > 0)) return {};
  const Vec3 normal =
      distance > 0 ? Vec3(apart / distance) : Vec3(Vec3::UnitZ());  // coincident: any way out will do
  return along(normal, delta, b + (radius_b - 0.5 * delta) * normal);
}

Touch touch_floor(const Vec3& centre, double radius) {
  const double delta = radius - centre.z();
  return along(Vec3::UnitZ(), delta, Vec3(centre.x(), centre.y(), -0.5 * delta));
}

Touch touch_tube(const Vec3& centre, double radius, double tube) {
  const Vec3 out(centre.x(), centre.y(), 0);
  const double distance = out.norm(), delta = distance + radius - tube;
  if (!(delta > 0) || !(distance > 0)) return {};
  const Vec3 normal = -out / distance;
  return along(normal, delta, centre - (radius - 0.5 * delta) * normal);
}

}  // namespace packbed
