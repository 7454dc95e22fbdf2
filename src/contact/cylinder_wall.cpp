#include <algorithm>
#include <cmath>

#include "contact/circle.hpp"
#include "contact/cylinder.hpp"

namespace packbed {
namespace {

/// The rim at one end, seen from the centre of the rod.
Circle rim_of(const Rod& rod, double side) {
  Circle circle{side * rod.half_height * rod.axis, {}, {}, rod.radius};
  span_plane(rod.axis, Vec3(0, 0, 1), circle.e1, circle.e2);
  return circle;
}

void add_floor_arc(TouchSum<kCurveExponent>& sum, const Circle& rim, const TrigQuadratic& depth,
                   const Arc& arc) {
  ArcSums t;
  sum_arc(depth, arc, t);
  const Pressure pressure = pressure_of(rim, t);
  const Vec3 down(0, 0, -1);
  sum.add_sums(rim.radius * t.power, pressure.total * down, pressure.x.cross(down), pressure, t.deepest);
}

/// The slope of the depth at x is the level part of (x - axis of the tube) / its radius.
void add_tube_arc(TouchSum<kCurveExponent>& sum, const Circle& rim, const TrigQuadratic& depth,
                  const Arc& arc, const Vec3& centre, double tube) {
  ArcSums t;
  sum_arc(depth, arc, t);
  const Pressure p = pressure_of(rim, t);
  const Vec3 outward(p.x.x() + p.total * centre.x(), p.x.y() + p.total * centre.y(), 0);
  // sum of x cross (x + centre, levelled)
  const Mat3& xx = p.xx;
  const Vec3 turn(-xx(2, 1) - p.x.z() * centre.y(), xx(2, 0) + p.x.z() * centre.x(),
                  p.x.x() * centre.y() - p.x.y() * centre.x());
  sum.add_sums(rim.radius * t.power, outward / tube, turn / tube, p, t.deepest);
}

/// (rho^2 - R^2) / 2R along a rim in a tube; `flat`: centre of the rim, levelled.
TrigQuadratic depth_in_tube(const Circle& rim, const Vec3& flat, double tube) {
  const Vec3 &e1 = rim.e1, &e2 = rim.e2;
  const double r = rim.radius, scale = 0.5 / tube;
  const double a1 = e1.x() * e1.x() + e1.y() * e1.y(), a2 = e2.x() * e2.x() + e2.y() * e2.y();
  const double a12 = e1.x() * e2.x() + e1.y() * e2.y();
  return {scale * (flat.squaredNorm() - tube * tube + r * r * a2), scale * 2 * r * flat.dot(e1),
          scale * 2 * r * flat.dot(e2), scale * r * r * (a1 - a2), scale * 2 * r * r * a12};
}

}  // namespace

Touch touch_floor(const Rod& rod, double& gap) {
  TouchSum<kCurveExponent> sum(rod.centre);
  gap = 1e300;
  for (const double side : {-1.0, 1.0}) {
    const Circle rim = rim_of(rod, side);
    const double height = rod.centre.z() + rim.centre.z(), swing = rod.radius * rim.e1.z();
    gap = std::min(gap, height - swing);
    if (height >= swing) continue;
    const TrigQuadratic depth{-height, -swing, 0, 0, 0};  // e2 lies level
    if (height <= -swing) {
      add_floor_arc(sum, rim, depth, {0, 2.0 * kPi, true});
    } else {
      const double reach = std::acos(height / swing);
      add_floor_arc(sum, rim, depth, {kPi - reach, kPi + reach});
    }
  }
  return sum.finish(2.0 * kPi * rod.radius, Vec3::Zero(), Vec3::Zero());
}

Touch touch_tube(const Rod& rod, double tube, double& gap) {
  TouchSum<kCurveExponent> sum(rod.centre);
  const Vec3 centre(rod.centre.x(), rod.centre.y(), 0);
  gap = 1e300;
  for (const double side : {-1.0, 1.0}) {
    const Circle rim = rim_of(rod, side);
    const Vec3 flat(centre.x() + rim.centre.x(), centre.y() + rim.centre.y(), 0);
    const double distance = flat.norm(), across = distance > 0 ? flat.dot(rod.axis) / distance : 0.0;
    // how far the rim reaches along the radius through its centre, and no further than its own radius
    // sideways
    const double out = distance + rod.radius * std::sqrt(std::max(0.0, 1.0 - across * across));
    const double reach = std::min(distance + rod.radius, std::hypot(out, rod.radius));
    if (reach <= tube) {
      gap = std::min(gap, tube - reach);
      continue;
    }
    const TrigQuadratic depth = depth_in_tube(rim, flat, tube);
    const PeakList peaks = positive_peaks(depth);
    // (R^2 - rho^2) / 2R is at most the way to the wall
    // (an arc that has only just begun may sum up to nothing)
    gap = std::min(gap, peaks.size == 0 ? -peaks.below : 0.0);
    for (int i = 0; i < peaks.size; ++i)
      add_tube_arc(sum, rim, depth, arc_round(depth, peaks.peak[static_cast<std::size_t>(i)], kWholeArc),
                   centre, tube);
  }
  return sum.finish(2.0 * kPi * rod.radius, Vec3::Zero(), Vec3::Zero());
}

}  // namespace packbed
