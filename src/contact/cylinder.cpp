#include "contact/cylinder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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
// Length that the touch of two crossed sides counts for, fraction of the reference length: with it, it is
// about as stiff as an edge.
constexpr double kSideLength = 0.05;
// Sine of the angle between axes under which the crossing fades out and the rims alone carry the touch of two
// sides.
constexpr double kParallel = 0.03;

// How fast the first harmonic of R^2 - rho^2 along a circle of radius r, less four times the second, can
// change with the travel of the bodies, over r: 2 r (the centre) + 4 r (turns) of the first, 4 r of the
// second, doubled.
constexpr double kHarmonicRate = 20;
// Way after which a circle that may get a second maximum at any moment is looked at again, fraction of its
// radius.
constexpr double kLookAgain = 1e-3;

constexpr std::uint8_t kCircles = 4 * kEnd.size();
static_assert(kCircles == RodFeatures::kCrossing);
constexpr float kFar = 1e30F;  // a way that nothing goes
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

/// Circles of a come first.
bool of_a(std::uint8_t circle) {
  return circle < 2 * kEnd.size();
}

/// One of the circles of a pair: rims, rings in the caps and rings round the side.
struct Feature {
  Vec3 centre;
  double radius;
  const Rod *owner, *other;
};

Feature circle_of(std::uint8_t circle, const Rod& a, const Rod& b) {
  const Rod& rod = of_a(circle) ? a : b;
  const std::size_t k = circle % (2 * kEnd.size());
  const Place& place = kEnd[k % kEnd.size()];
  const double end = k < kEnd.size() ? -1.0 : 1.0;
  return {rod.centre + end * place.height * rod.half_height * rod.axis, place.radius * rod.radius, &rod,
          of_a(circle) ? &b : &a};
}

/// What a look at one circle finds.
struct Finding {
  std::array<RodArc, 8> arc;
  std::size_t size = 0;
  double gap = 1e30;  // way to go before it can touch where it does not

  void add(const RodArc& a) {
    if (size < arc.size()) arc[size++] = a;
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

void add_whole(Finding& found, std::uint8_t circle, const Arc& arc) {
  RodArc a{arc.from, arc.to, circle, arc.from_name == kCap, arc.to_name == kCap, 0, arc.full};
  if (arc.full || arc.to - arc.from > kWideArc) {
    a.half = 1;
    found.add(a);
    a.half = 2;
  }
  found.add(a);
}

/// The plane of the circles of one body, seen from the other: the same for all of them.
struct Plane {
  Vec3 e1, e2;
  double sine = 0;    // between the axes
  double turned = 0;  // angle from the vector that looks share to e1

  Plane(const Vec3& axis, const Vec3& other, const Vec3& wish) {
    span_plane(axis, other, e1, e2);
    const double cosine = axis.dot(other);
    sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    turned = std::atan2(e1.dot(axis.cross(wish)), e1.dot(wish));
  }
};

/// Looks at one circle: the arcs that dip in, and how far the rest of it is from that.
void find_arcs(Finding& found, std::uint8_t circle, const Feature& f, const Plane& plane) {
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
    return;
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
  if (sides.size == 0) return;
  const ArcList both = intersection(sides, caps);
  for (int i = 0; i < both.size; ++i) add_whole(found, circle, both.arc[static_cast<std::size_t>(i)]);
  for (int i = 0; i < caps.size; ++i) {
    const Arc& arc = caps.arc[static_cast<std::size_t>(i)];
    if (!arc.full)
      found.gap = std::min(
          {found.gap, way_beyond(g, sides, caps, arc.to, 1.0), way_beyond(g, sides, caps, arc.from, -1.0)});
  }
}

/// The sides of two crossed cylinders, at the common perpendicular of their axes. Closed form; s and t are
/// its feet on the axes. Gives the way to go before they can touch there; negative when they do.
double add_crossing(TouchSum<kCurveExponent>& sum, const Rod& a, const Rod& b, double reference) {
  const Vec3 w = b.centre - a.centre;
  const double c = a.axis.dot(b.axis), sine2 = 1.0 - c * c;
  if (sine2 < 1e-8) return 0;
  const double wa = w.dot(a.axis), wb = w.dot(b.axis);
  const double s = (wa - c * wb) / sine2, t = (c * wa - wb) / sine2;
  const Vec3 across = w + t * b.axis - s * a.axis;
  const double radii = a.radius + b.radius;
  const double lateral = (radii * radii - across.squaredNorm()) / (2.0 * radii);
  const double beyond = std::max(std::abs(s) - a.half_height, std::abs(t) - b.half_height);
  // a foot moves by at most some twelve times the bodies' travel over sine squared
  if (!(lateral > 0) || beyond >= 0) return std::max(across.norm() - radii, beyond * sine2 / 12.0);
  // depth: R-function of the overlap of the sides with the distances from the four ends
  const double end_a = (a.half_height * a.half_height - s * s) / (2.0 * a.half_height);
  const double end_b = (b.half_height * b.half_height - t * t) / (2.0 * b.half_height);
  const double ends = std::sqrt(end_a * end_a + end_b * end_b), end = end_a + end_b - ends;
  const double norm = std::sqrt(lateral * lateral + end * end), d = lateral + end - norm;
  // weight: fades for parallel axes, where rims and rings carry, and towards the ends, where a rim takes over
  const double parallel2 = kParallel * kParallel, fade = sine2 / (sine2 + parallel2);
  const double share_a = 2.0 * end_a / a.half_height, share_b = 2.0 * end_b / b.half_height;
  const double length = kSideLength * reference * fade * share_a * share_b,
               power = length * depth_power<kCurveExponent>(d);
  const double rate = length * depth_power_slope<kCurveExponent>(d);
  const double by_lateral = rate * (1.0 - lateral / norm), by_end = rate * (1.0 - end / norm);
  const double by_s = -(by_end * (1.0 - end_a / ends) + power / end_a) * s / a.half_height;
  const double by_t = -(by_end * (1.0 - end_b / ends) + power / end_b) * t / b.half_height;
  const double by_sine2 = power * parallel2 / (sine2 * (sine2 + parallel2));
  // derivatives by w = b - a, and by the axes; s and t follow from across.a = across.b = 0
  const double p = (by_s + by_t * c) / sine2, q = -(by_s * c + by_t) / sine2;
  const double pull = -by_lateral / radii;
  const Vec3 by_w = pull * across + p * a.axis + q * b.axis;
  const Vec3 by_a = -s * pull * across + p * (w + t * b.axis) - q * s * b.axis - 2.0 * c * by_sine2 * b.axis;
  const Vec3 torque = -a.axis.cross(by_a) + a.centre.cross(by_w);
  const Vec3 x = a.centre + s * a.axis + (a.radius / radii) * across;
  sum.add_sums(power, -by_w, -torque, {rate, rate * x, rate * x * x.transpose()}, std::min(lateral, end));
  return -1;
}

void set_lane(RodArcBatch& batch, int k, const RodArc& arc, const Rod& a, const Rod& b,
              const RodFeatures& features) {
  const Feature f = circle_of(arc.circle, a, b);
  const auto set = [k](LaneVec& lanes, const Vec3& v) {
    lanes.x[k] = v.x();
    lanes.y[k] = v.y();
    lanes.z[k] = v.z();
  };
  set(batch.centre, f.centre - f.other->centre);
  set(batch.owner, f.owner->axis);
  set(batch.wish, of_a(arc.circle) ? features.wish_a : features.wish_b);
  set(batch.axis, f.other->axis);
  set(batch.origin, f.other->centre);
  batch.sign[k] = of_a(arc.circle) ? 1.0 : -1.0;
  batch.radius[k] = f.radius;
  batch.rod_radius[k] = f.other->radius;
  batch.half_height[k] = f.other->half_height;
  batch.from[k] = arc.from;
  batch.to[k] = arc.to;
  batch.from_cap[k] = arc.from_cap;
  batch.to_cap[k] = arc.to_cap;
  batch.part[k] = arc.half == 2 ? 0.5 : 0.0;
  batch.span[k] = arc.half == 0 ? 1.0 : 0.5;
  batch.full[k] = arc.full;
}

void add_arcs(TouchSum<kCurveExponent>& sum, const std::array<double, kArcSums>& total, double deepest) {
  Pressure pressure{
      total[kPressure], {total[kPressureX], total[kPressureY], total[kPressureZ]}, Mat3::Zero()};
  pressure.xx << total[kXX], total[kXY], total[kXZ], total[kXY], total[kYY], total[kYZ], total[kXZ],
      total[kYZ], total[kZZ];
  sum.add_sums(total[kPower], {total[kForceX], total[kForceY], total[kForceZ]},
               {total[kTorqueX], total[kTorqueY], total[kTorqueZ]}, pressure, deepest);
}

/// `gap` further than `gone`, rounded down.
float later(float gone, double gap) {
  return gone + 0.999F * static_cast<float>(std::clamp(gap, 0.0, static_cast<double>(kFar)));
}

/// Looks at one circle afresh: its arcs take the place of those known.
void look_again(std::uint8_t circle, const Rod& a, const Rod& b, float gone, std::optional<Plane>& plane,
                RodFeatures& features) {
  const Feature f = circle_of(circle, a, b);
  // angles are kept from the vector that all looks share, which e1 has turned away from
  if (!plane) plane.emplace(f.owner->axis, f.other->axis, of_a(circle) ? features.wish_a : features.wish_b);
  Finding found;
  find_arcs(found, circle, f, *plane);
  const auto end = std::remove_if(features.arc.begin(), features.arc.begin() + features.arcs,
                                  [&](const RodArc& arc) { return arc.circle == circle; });
  features.arcs = static_cast<std::uint8_t>(end - features.arc.begin());
  features.until[circle] = later(gone, found.gap);
  for (std::size_t k = 0; k < found.size; ++k) {
    if (features.arcs == RodFeatures::kMostArcs) {
      features.until[circle] = gone;  // no room: look again next time
      return;
    }
    RodArc& arc = features.arc[features.arcs++] = found.arc[k];
    if (arc.full) continue;
    arc.from += plane->turned;
    arc.to += plane->turned;
  }
}

Rod seen_from(const Vec3& origin, const Rod& rod) {
  return {rod.centre - origin, rod.axis, rod.radius, rod.half_height};
}

double reference_length(const Rod& a, const Rod& b) {
  return 2.0 * kPi * std::min(a.radius, b.radius);
}

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

double RodFeatures::due() const {
  return static_cast<double>(*std::min_element(until.begin(), until.end())) - gone;
}

void RodFeatures::follow(const Rod& a, const Rod& b) {
  const Vec3 now = b.centre - a.centre;
  const double way = (now - apart).norm() + std::hypot(a.radius, a.half_height) * (a.axis - axis_a).norm() +
                     std::hypot(b.radius, b.half_height) * (b.axis - axis_b).norm();
  gone += way;
  apart = now;
  axis_a = a.axis;
  axis_b = b.axis;
}

Touch touch_cylinders(const Rod& a, const Rod& b, RodFeatures& features) {
  Vec3 unused;
  span_plane(a.axis, b.axis, features.wish_a, unused);
  span_plane(b.axis, a.axis, features.wish_b, unused);
  features.apart = b.centre - a.centre;
  features.axis_a = a.axis;
  features.axis_b = b.axis;
  features.gone = 0;
  features.until.fill(0.0F);
  features.arcs = 0;
  features.crossing = false;
  features.known = true;
  thread_local RodLooks looks;
  Touch out;
  looks.add(0, a, b, features);
  looks.finish([&](std::uint32_t, const Touch& touch, bool lost) {
    out = touch;
    if (lost) features.known = false;
  });
  return out;
}

Touch touch_cylinders(const Rod& a, const Rod& b) {
  RodFeatures features;
  return touch_cylinders(a, b, features);
}

void RodLooks::add(std::uint32_t tag, const Rod& a, const Rod& b, RodFeatures& features) {
  features.follow(a, b);
  const Vec3 origin = 0.5 * (a.centre + b.centre);
  Entry& e = pair_[static_cast<std::size_t>(pairs_++)];
  e = {tag, lanes_, origin, seen_from(origin, a), seen_from(origin, b), &features};
  const auto gone = static_cast<float>(features.gone);
  std::optional<Plane> plane_a, plane_b;
  for (std::uint8_t k = 0; k < kCircles; ++k)
    if (gone >= features.until[k]) look_again(k, e.a, e.b, gone, of_a(k) ? plane_a : plane_b, features);
  for (std::size_t k = 0; k < features.arcs; ++k, ++lanes_)
    set_lane(batch_[static_cast<std::size_t>(lanes_ / kLanes)], lanes_ % kLanes, features.arc[k], e.a, e.b,
             features);
}

void RodLooks::evaluate() {
  // idle lanes of the last batch hold what an earlier one has left there
  for (int first = 0; first < lanes_; first += kLanes)
    follow(batch_[static_cast<std::size_t>(first / kLanes)]);
}

Touch RodLooks::result(int i, bool& lost) const {
  const Entry& e = pair_[static_cast<std::size_t>(i)];
  RodFeatures& features = *e.features;
  TouchSum<kCurveExponent> sum(e.origin);
  std::array<double, kArcSums> total{};
  double deepest = 0;
  for (std::size_t k = 0; k < features.arcs; ++k) {
    const int place = e.lane + static_cast<int>(k), lane = place % kLanes;
    const RodArcBatch& batch = batch_[static_cast<std::size_t>(place / kLanes)];
    RodArc& arc = features.arc[k];
    arc.from = batch.from[lane];
    arc.to = batch.to[lane];
    if (!(batch.holds[lane] > 0)) lost = true;
    for (std::size_t q = 0; q < kArcSums; ++q) total[q] += batch.sum[q][lane];
    deepest = std::max(deepest, static_cast<double>(batch.deepest[lane]));
  }
  if (features.arcs > 0) add_arcs(sum, total, deepest);
  const double reference = reference_length(e.a, e.b);
  const auto gone = static_cast<float>(features.gone);
  float& until = features.until[RodFeatures::kCrossing];
  if (features.crossing || gone >= until) {
    const double gap = add_crossing(sum, e.a, e.b, reference);
    features.crossing = gap < 0;
    until = features.crossing ? kFar : later(gone, gap);
  }
  return sum.finish(reference, e.a.centre, e.b.centre);
}

}  // namespace packbed
