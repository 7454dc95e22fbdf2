#include <cmath>

#include "contact/circle.hpp"
#include "contact/cylinder.hpp"
#include "math/trig.hpp"

namespace packbed {
namespace {

/// Adds the nodes between two angles of a circle; gives what moving either of them changes in the sum.
template <class Field>
std::pair<double, double> add_panel(TouchSum& sum, const Circle& circle, const TrigQuadratic& depth,
                                    const Field& slope_at, double from, double to, bool full) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double power = 0, shift = 0, spread = 0;
  for (std::size_t k = 0; k < kArcNodes; ++k) {
    const double xi = full ? kEvenNode[k] : kGaussNode[k],
                 w = circle.radius * (full ? kEvenWeight[k] : kGaussWeight[k]);
    double s, c;
    sincos_poly(middle + half * xi, s, c);
    const double d = depth.at(c, s);
    if (!(d > 0)) continue;
    const Vec3 x = circle.point(c, s);
    sum.add(x, d, half * w, slope_at(x));
    const double along = half * w * depth_power_slope(d) * depth.slope(c, s);
    power += w * depth_power(d);
    shift += along;
    spread += along * xi;
  }
  return {0.5 * (shift - spread - power), 0.5 * (shift + spread + power)};
}

/// One circle against a field that is a quadratic of the position along it: floor and tube.
template <class Field>
void add_circle(TouchSum& sum, const Circle& circle, const TrigQuadratic& depth, const Field& slope_at) {
  const ArcList arcs = positive_arcs(depth, 0);
  for (int i = 0; i < arcs.size; ++i) {
    const Arc& arc = arcs.arc[static_cast<std::size_t>(i)];
    if (arc.from_root < 0) {
      add_panel(sum, circle, depth, slope_at, arc.from, arc.to, true);
      continue;
    }
    const auto ends = over_panels(arc, [&](double from, double to) {
      return add_panel(sum, circle, depth, slope_at, from, to, false);
    });
    for (const bool first : {true, false}) {
      double s, c;
      sincos_poly(first ? arc.from : arc.to, s, c);
      const double turn = depth.slope(c, s);
      if (std::abs(turn) < 1e-12 * circle.radius) continue;
      const Vec3 x = circle.point(c, s);
      sum.add_end(x, -(first ? ends.first : ends.second) / turn, slope_at(x));
    }
  }
}

}  // namespace

Touch touch_floor(const Rod& rod) {
  TouchSum sum(rod.centre);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 offset = side * rod.half_height * rod.axis;
    const double height = rod.centre.z() + offset.z();
    if (height >= rod.radius) continue;
    Circle circle{offset, {}, {}, rod.radius};
    span_plane(rod.axis, Vec3(0, 0, 1), circle.e1, circle.e2);
    const TrigQuadratic depth{-height, -rod.radius * circle.e1.z(), -rod.radius * circle.e2.z(), 0, 0};
    add_circle(sum, circle, depth, [](const Vec3&) { return Vec3(0, 0, -1); });
  }
  return sum.finish(2.0 * kPi * rod.radius, Vec3::Zero(), Vec3::Zero());
}

Touch touch_tube(const Rod& rod, double tube) {
  TouchSum sum(rod.centre);
  const Vec3 centre(rod.centre.x(), rod.centre.y(), 0);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 offset = side * rod.half_height * rod.axis;
    const Vec3 flat(centre.x() + offset.x(), centre.y() + offset.y(), 0);
    if (flat.norm() + rod.radius <= tube) continue;
    Circle circle{offset, {}, {}, rod.radius};
    span_plane(rod.axis, Vec3(0, 0, 1), circle.e1, circle.e2);
    // (rho^2 - R^2) / 2R along the circle
    const double r = rod.radius, scale = 0.5 / tube;
    const double a1 = circle.e1.x() * circle.e1.x() + circle.e1.y() * circle.e1.y();
    const double a2 = circle.e2.x() * circle.e2.x() + circle.e2.y() * circle.e2.y();
    const double a12 = circle.e1.x() * circle.e2.x() + circle.e1.y() * circle.e2.y();
    const TrigQuadratic depth{scale * (flat.squaredNorm() - tube * tube + r * r * a2),
                              scale * 2 * r * flat.dot(circle.e1), scale * 2 * r * flat.dot(circle.e2),
                              scale * r * r * (a1 - a2), scale * 2 * r * r * a12};
    add_circle(sum, circle, depth, [&](const Vec3& x) {
      return Vec3((x.x() + centre.x()) / tube, (x.y() + centre.y()) / tube, 0);
    });
  }
  return sum.finish(2.0 * kPi * rod.radius, Vec3::Zero(), Vec3::Zero());
}

}  // namespace packbed
