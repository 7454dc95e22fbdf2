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

// Length that the touch of two crossed sides counts for, fraction of the reference length: with it, it is
// about as stiff as an edge.
constexpr double kSideLength = 0.05;
// Sine of the angle between axes under which the crossing fades out and the rims alone carry the touch of two
// sides.
constexpr double kParallel = 0.03;

constexpr float kFar = 1e30F;  // a way that nothing goes

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
  const RodCircle f = circle_of(arc.circle, a, b);
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
void look_again(std::uint8_t circle, const Rod& a, const Rod& b, float gone, std::optional<RodPlane>& plane,
                RodFeatures& features) {
  const RodCircle f = circle_of(circle, a, b);
  // angles are kept from the vector that all looks share, which e1 has turned away from
  if (!plane) plane.emplace(f.owner->axis, f.other->axis, of_a(circle) ? features.wish_a : features.wish_b);
  const ArcsFound found = find_arcs(circle, f, *plane);
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

}  // namespace

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
  std::optional<RodPlane> plane_a, plane_b;
  for (std::uint8_t k = 0; k < kRodCircles; ++k)
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
