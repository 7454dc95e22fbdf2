#include "contact/rod_circles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/circle.hpp"
#include "math/trig.hpp"

namespace packbed {
namespace {

// Circles at one end of a cylinder: the rim; two rings in its cap, which carry caps whose rims lie on one
// another; two round its side, which carry parallel sides whose caps are level. Those near the rim see two
// caps or sides that lean together by an edge, those further in still rise where the others end: how deep a
// circle sees is limited by its distance from the rim.
struct Place {
  double radius, height;  // fractions of the radius and of the half height
};
constexpr std::array<Place, 5> kEnd = {{{1, 1}, {0.7, 1}, {0.97, 1}, {1, 0.6}, {1, 0.97}}};
static_assert(kRodCircles == 4 * kEnd.size());

// How fast the first harmonic of R^2 - rho^2 along a circle of radius r, less four times the second, can
// change with the travel of the bodies, over r: 2 r (the centre) + 4 r (turns) of the first, 4 r of the
// second, doubled.
constexpr double kHarmonicRate = 20;
// Way after which a circle that may get a second maximum at any moment is looked at again, fraction of its
// radius.
constexpr double kLookAgain = 1e-3;

enum EndName { kSide = 0, kCap = 1 };

/// A circle in the frame of a cylinder: everything is a trigonometric polynomial of the angle phi.
struct CircleInRod {
  double w2, p, q;  // |x - centre of the rod|^2 = w2 + p cos + q sin
  double z0, z1;    // height over the rod's middle = z0 + z1 cos
  double radius, half_height;

  TrigQuadratic side() const {  // R^2 - rho^2
    return {radius * radius - w2 + z0 * z0, -p + 2 * z0 * z1, -q, z1 * z1, 0};
  }
  /// How far a point of the circle is outside of the side and of the caps: negative inside.
  std::pair<double, double> outside(double phi) const {
    double s, c;
    sincos_poly(phi, s, c);
    const double z = z0 + z1 * c, y2 = w2 + p * c + q * s;
    return {(y2 - z * z - radius * radius) / (2.0 * radius),
            (z * z - half_height * half_height) / (2.0 * half_height)};
  }
};

/// Arcs of the circle with |z0 + z1 cos phi| < h: one, or two that mirror one another.
ArcList arcs_between_caps(const CircleInRod& g) {
  ArcList arcs;
  const double sign = g.z1 < 0 ? -1.0 : 1.0, size = std::abs(g.z1);
  const double low = (-g.half_height - sign * g.z0) / size,
               high = (g.half_height - sign * g.z0) / size;  // of sign cos
  if (!(size > 0) || (low <= -1.0 && high >= 1.0)) {
    if (std::abs(g.z0) < g.half_height) arcs.add({0, 2.0 * kPi, true});
    return arcs;
  }
  if (low >= 1.0 || high <= -1.0) return arcs;
  const double turn = sign < 0 ? kPi : 0.0;
  const double near = high >= 1.0 ? 0.0 : std::acos(high), far = low <= -1.0 ? kPi : std::acos(low);
  if (high >= 1.0)
    arcs.add({turn - far, turn + far, false, kCap, kCap});
  else if (low <= -1.0)
    arcs.add({turn + near, turn + 2.0 * kPi - near, false, kCap, kCap});
  else {
    arcs.add({turn + near, turn + far, false, kCap, kCap});
    arcs.add({turn - far, turn - near, false, kCap, kCap});
  }
  return arcs;
}

/// Half of the least way into the rod from the part of a circle between an end of an arc in the side and one
/// in the caps: there it leaves the one and comes near the other, and is nearest to both where it is as far
/// from the one as from the other. Looked for by regula falsi: a few per cent are near enough.
double way_between(const CircleInRod& g, double in_side, double in_caps) {
  double by_side = -g.outside(in_side).second, by_caps = g.outside(in_caps).first;  // of side less cap
  double way = 0;
  for (int i = 0; i < 3; ++i) {
    const double spread = by_caps - by_side;
    const double middle =
        spread > 0 ? in_side - by_side / spread * (in_caps - in_side) : 0.5 * (in_side + in_caps);
    const auto [side, cap] = g.outside(middle);
    (side < cap ? in_side : in_caps) = middle;
    (side < cap ? by_side : by_caps) = side - cap;
    way = std::max(side, cap);
  }
  return 0.5 * std::max(0.0, way);
}

/// Angle from `start` to the nearest arc of a list, forwards (side +1) or backwards (-1); 0 inside of one.
double angle_to_next(const ArcList& arcs, double start, double side) {
  double least = 2.0 * kPi;
  for (int i = 0; i < arcs.size; ++i) {
    const Arc& arc = arcs.arc[static_cast<std::size_t>(i)];
    const auto turned = [&](double to) {
      const double angle = side * (to - start);
      return angle - 2.0 * kPi * std::floor(angle / (2.0 * kPi));
    };
    const double near = turned(side > 0 ? arc.from : arc.to), far = turned(side > 0 ? arc.to : arc.from);
    if (arc.full || far < near) return 0;
    least = std::min(least, near);
  }
  return least;
}

/// The way to go before an arc in the side may come to overlap the end of one between the caps from outside,
/// which would be a new touch.
double way_beyond(const CircleInRod& g, const ArcList& sides, const ArcList& caps, double end, double side) {
  const double way = angle_to_next(sides, end, side);
  const double other = angle_to_next(caps, end + side * 1e-9, side);
  return way > 0 && way < other ? way_between(g, end + side * way, end) : 1e300;
}

void add_whole(ArcsFound& found, std::uint8_t circle, const Arc& arc) {
  RodArc a{arc.from, arc.to, circle, arc.from_name == kCap, arc.to_name == kCap, 0, arc.full};
  if (arc.full || arc.to - arc.from > kWideArc) {
    a.half = 1;
    found.add(a);
    a.half = 2;
  }
  found.add(a);
}

}  // namespace

RodCircle circle_of(std::uint8_t circle, const Rod& a, const Rod& b) {
  const Rod& rod = of_a(circle) ? a : b;
  const std::size_t k = circle % (2 * kEnd.size());
  const Place& place = kEnd[k % kEnd.size()];
  const double end = k < kEnd.size() ? -1.0 : 1.0;
  return {rod.centre + end * place.height * rod.half_height * rod.axis, place.radius * rod.radius, &rod,
          of_a(circle) ? &b : &a};
}

RodPlane::RodPlane(const Vec3& axis, const Vec3& other, const Vec3& wish) {
  span_plane(axis, other, e1, e2);
  const double cosine = axis.dot(other);
  sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  turned = std::atan2(e1.dot(axis.cross(wish)), e1.dot(wish));
}

ArcsFound find_arcs(std::uint8_t circle, const RodCircle& f, const RodPlane& plane) {
  ArcsFound found;
  const Rod& rod = *f.other;
  const Vec3 w = f.centre - rod.centre, &axis = f.owner->axis;
  const double z0 = w.dot(rod.axis), reach = f.radius * plane.sine;
  const Vec3 rho = w - z0 * rod.axis;
  const double rho2 = rho.squaredNorm(), distance = std::sqrt(rho2), across = rho.dot(axis);
  // extent of the circle towards the rod's axis: radius sqrt(1 - (m.axis)^2), m = rho / |rho|
  const double inward = f.radius * std::sqrt(std::max(0.0, rho2 - across * across));
  const double cap_gap = std::abs(z0) - reach - rod.half_height;
  const double side_gap = distance > 0 ? distance - inward / distance - rod.radius : -rod.radius;
  if (cap_gap >= 0 || side_gap >= 0) {
    found.gap = std::min(found.gap, std::max(cap_gap, side_gap));
    return found;
  }
  const CircleInRod g{w.squaredNorm() + f.radius * f.radius,
                      2 * f.radius * w.dot(plane.e1),
                      2 * f.radius * w.dot(plane.e2),
                      z0,
                      f.radius * rod.axis.dot(plane.e1),
                      rod.radius,
                      rod.half_height};
  const TrigQuadratic side = g.side();
  const PeakList peaks = positive_peaks(side);
  if (peaks.below > -1e299)
    found.gap = std::min(found.gap, std::sqrt(rod.radius * rod.radius - peaks.below) - rod.radius);
  if (peaks.size > 0)
    found.gap = std::min(found.gap, std::max(peaks.lone / (kHarmonicRate * f.radius), kLookAgain * f.radius));
  const ArcList caps = arcs_between_caps(g);
  ArcList sides;
  for (int i = 0; i < peaks.size; ++i)
    sides.add(arc_round(side, peaks.peak[static_cast<std::size_t>(i)], kCutArc));
  if (sides.size == 0) return found;
  const ArcList both = intersection(sides, caps);
  for (int i = 0; i < both.size; ++i) add_whole(found, circle, both.arc[static_cast<std::size_t>(i)]);
  for (int i = 0; i < caps.size; ++i) {
    const Arc& arc = caps.arc[static_cast<std::size_t>(i)];
    if (!arc.full)
      found.gap = std::min(
          {found.gap, way_beyond(g, sides, caps, arc.to, 1.0), way_beyond(g, sides, caps, arc.from, -1.0)});
  }
  return found;
}

}  // namespace packbed
