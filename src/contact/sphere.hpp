#pragma once
// Contact of spheres: closed form, no orientation.
#include "contact/touch.hpp"

namespace packbed {

Touch touch_spheres(const Vec3& a, double radius_a, const Vec3& b, double radius_b);
/// With the half space z < 0.
Touch touch_floor(const Vec3& centre, double radius);
/// With the outside of an upright tube of inner radius `tube` round the z axis.
Touch touch_tube(const Vec3& centre, double radius, double tube);

}  // namespace packbed
