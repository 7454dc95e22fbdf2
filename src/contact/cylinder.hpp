#pragma once
// Contact between solid cylinders, and of a cylinder with a floor and with the wall of a tube. Analytic: no
// mesh, no samples on the surface. The features that carry the touch, each integrated where it dips into the
// other body and nowhere else:
//
//     rim in cylinder     four rims; an arc of Gauss nodes between exact end points     edge and face touches
//     ring in cylinder    a ring inside each cap, two round the side                    coaxial caps, level
//     parallel sides side against side   the common perpendicular of the axes, closed form crossed cylinders
//
// The depth of a point in a cylinder of radius R and half height h, at distance rho from the axis and height
// z:
//     a = (R^2 - rho^2) / 2R,   b = (h^2 - z^2) / 2h,   depth = a + b - sqrt(a^2 + b^2)   for a, b > 0
// It is smooth inside, never larger than the nearer of the two distances, and of unit slope at the surface
// (Rvachev's R-function).
#include <array>
#include <cstdint>

#include "contact/touch.hpp"

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

/// Which features of a pair are worth a look. A pair that stays where it is needs only those that touch.
struct RodFeatures {
  std::uint16_t mask = 0x1fff;  // in: features to look at; out: those that touch
  // in and out: circles that touch at one place each, and the angle of that place; none: look afresh
  std::uint8_t tracked = 0;
  std::array<std::uint8_t, 4> circle{};
  std::array<double, 4> phi{};
  double gap = 0;  // out: way that the surfaces may go before another of those looked at can touch [m]
};

Touch touch_cylinders(const Rod& a, const Rod& b);
/// Looks only at the features of the mask.
Touch touch_cylinders(const Rod& a, const Rod& b, RodFeatures& features);
/// With the half space z < 0.
Touch touch_floor(const Rod& rod);
/// With the outside of an upright tube of inner radius `tube` round the z axis, without end up and down.
Touch touch_tube(const Rod& rod, double tube);

/// Depth and its slope at x, relative to the centre of the cylinder; 0 outside.
double depth_in_cylinder(const Vec3& x, const Vec3& axis, double radius, double half_height, Vec3& slope);

}  // namespace packbed
