#include "contact/cylinder.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/circle.hpp"
#include "math/simd.hpp"
#include "math/trig.hpp"

namespace packbed {
namespace {

// Radius of the ring inside each cap, fraction of the cap's: it carries coaxial caps, whose rims lie on one
// another.
constexpr double kCapRing = 0.6;
// Height of the two rings round the side, fraction of the half height: they carry parallel sides whose caps
// are level.
constexpr double kSideRing = 0.5;
// Length that the touch of two crossed sides counts for, fraction of the reference length: with it, it is
// about as stiff as an edge.
constexpr double kSideLength = 0.05;
// Sine of the angle between axes under which the crossing fades out and the rims alone carry the touch of two
// sides.
constexpr double kParallel = 0.03;

// An arc whose depth stays under this fraction of the greatest depth adds less than its 8th power, 1e-8, and
// is left out.
constexpr double kNegligible = 0.1;

// Features: 0 to 5 the circles of a, 6 to 11 those of b, 12 the crossing of the sides.
constexpr int kFeatures = 13, kCrossing = 12;

enum Root { kSide = 0, kCap = 1 };

using Nodes = std::array<double, kArcNodes>;

double total(const Nodes& v) {
  static_assert(kArcNodes == 12);
  const double a = (v[0] + v[4]) + v[8], b = (v[1] + v[5]) + v[9], c = (v[2] + v[6]) + v[10],
               d = (v[3] + v[7]) + v[11];
  return (a + b) + (c + d);
}

/// A circle in the frame of a cylinder: everything is a trigonometric polynomial of the angle phi.
struct CircleInRod {
  double w2, p, q;    // |x - centre of the rod|^2 = w2 + p cos + q sin
  double z0, z1, z2;  // height over the rod's middle = z0 + z1 cos + z2 sin
  double radius, half_height;

  TrigQuadratic side() const {  // R^2 - rho^2
    return {radius * radius - w2 + z0 * z0 + z2 * z2, -p + 2 * z0 * z1, -q + 2 * z0 * z2, z1 * z1 - z2 * z2,
            2 * z1 * z2};
  }
};

/// Sums over the nodes of one arc, with rate_i = w_i 8 d_i^7.
struct ArcSums {
  double power;                    // w d^8
  double shift, spread;            // rate d', rate d' xi: what moving or spreading the nodes does
  double side, side_c, side_s;     // rate (d d / d a) / R, and its moments with cos and sin
  double axial, axial_c, axial_s;  // the share along the axis
  double rate, rate_c, rate_s, rate_cc, rate_cs;
  double deepest;
};

/// All nodes of one arc of angles middle +- half. A full turn takes evenly spaced nodes (spectral for
/// periodic functions).
PACKBED_WIDE void sum_arc(const CircleInRod& g, double middle, double half, bool full, ArcSums& out) {
  Nodes power, shift, spread, side, side_c, side_s, axial, axial_c, axial_s, rate, rate_c, rate_s, rate_cc,
      rate_cs, deep;
  const double per_radius = 1.0 / g.radius, per_height = 1.0 / g.half_height;
  const double* node = full ? kEvenNode.data() : kGaussNode.data();
  const double* weight = full ? kEvenWeight.data() : kGaussWeight.data();
#pragma GCC unroll 1  // unrolled, the loop would not be vectorised
  for (std::size_t i = 0; i < kArcNodes; ++i) {
    const double xi = node[i], w = weight[i];
    double s, c;
    sincos_poly(middle + half * xi, s, c);
    const double z = g.z0 + g.z1 * c + g.z2 * s, z_dot = g.z2 * c - g.z1 * s;
    const double y2 = g.w2 + g.p * c + g.q * s, y2_dot = g.q * c - g.p * s;
    const double a = std::max(0.0, (g.radius * g.radius - y2 + z * z) * 0.5 * per_radius);
    const double b = std::max(0.0, (g.half_height * g.half_height - z * z) * 0.5 * per_height);
    const double norm = std::sqrt(a * a + b * b) + 1e-300, d = std::max(0.0, a + b - norm);
    const double slope_a = 1.0 - a / norm, slope_b = 1.0 - b / norm;
    const double d2 = d * d, d4 = d2 * d2, r = 8.0 * w * d4 * d2 * d;
    const double d_dot = slope_a * (z * z_dot - 0.5 * y2_dot) * per_radius - slope_b * z * z_dot * per_height;
    power[i] = w * d4 * d4;
    shift[i] = r * d_dot;
    spread[i] = r * d_dot * xi;
    side[i] = r * slope_a * per_radius;
    side_c[i] = side[i] * c;
    side_s[i] = side[i] * s;
    axial[i] = (side[i] - r * slope_b * per_height) * z;
    axial_c[i] = axial[i] * c;
    axial_s[i] = axial[i] * s;
    rate[i] = r;
    rate_c[i] = r * c;
    rate_s[i] = r * s;
    rate_cc[i] = r * c * c;
    rate_cs[i] = r * c * s;
    deep[i] = std::min(a, b);
  }
  out = {total(power),  total(shift),  total(spread),  total(side),    total(side_c),
         total(side_s), total(axial),  total(axial_c), total(axial_s), total(rate),
         total(rate_c), total(rate_s), total(rate_cc), total(rate_cs), 0.0};
  for (double d : deep) out.deepest = std::max(out.deepest, d);
}

/// The end of an arc lies where `side` or `cap` of the rod vanishes; it moves with the bodies, and so do the
/// nodes.
void add_arc_end(TouchSum& sum, const Circle& circle, double phi, int root, double rate, const Rod& rod,
                 double sign) {
  double s, c;
  sincos_poly(phi, s, c);
  const Vec3 x = circle.point(c, s), y = x - rod.centre,
             tangent = circle.radius * (c * circle.e2 - s * circle.e1);
  const double z = y.dot(rod.axis);
  const Vec3 slope =
      root == kSide ? Vec3(-(y - z * rod.axis) / rod.radius) : Vec3(-z / rod.half_height * rod.axis);
  const double turn = slope.dot(tangent);
  if (std::abs(turn) < 1e-12 * circle.radius) return;  // a touch that has only just begun: nothing to carry
  sum.add_end(x, -rate / turn, sign * slope);
}

/// A circle that dips into a rod, with the places where it is deepest in the side.
struct Dip {
  Circle circle;
  CircleInRod g;
  PeakList peaks;
  const Rod* rod = nullptr;
  int feature = 0;
  double sign = 0;  // +1 when the circle belongs to a, -1 when to b
};

struct Dips {
  std::array<Dip, kFeatures - 1> dip;
  int size = 0;
  double deepest = 0;  // of the depths found at the peaks: a lower bound of the greatest depth
  double gap = 1e300;  // way to go before a circle that does not dip can do so
  std::uint16_t mask = 0;

  void clear() {
    size = 0;
    deepest = 0;
    gap = 1e300;
    mask = 0;
  }
};

double depth_of(double side, double cap) {
  return side > 0 && cap > 0 ? side + cap - std::sqrt(side * side + cap * cap) : 0.0;
}

/// One of the twelve circles of a pair: 0 to 5 the rims, rings in the caps and rings round the side of a; 6
/// to 11 those of b.
struct Feature {
  Vec3 centre;
  double radius;
  const Rod *owner, *other;
};

Feature circle_of(int feature, const Rod& a, const Rod& b) {
  const bool of_a = feature < 6;
  const Rod& rod = of_a ? a : b;
  const int k = of_a ? feature : feature - 6;
  const double end = k < 3 ? -1.0 : 1.0;
  const double height = k % 3 == 2 ? kSideRing : 1.0, radius = k % 3 == 1 ? kCapRing : 1.0;
  return {rod.centre + end * height * rod.half_height * rod.axis, radius * rod.radius, &rod, of_a ? &b : &a};
}

/// Everything of a dip but its peaks.
void set_dip(Dip& dip, int feature, const Feature& f) {
  const Rod& rod = *f.other;
  const Vec3 w = f.centre - rod.centre;
  dip.circle.centre = f.centre;
  dip.circle.radius = f.radius;
  span_plane(f.owner->axis, rod.axis, dip.circle.e1, dip.circle.e2);
  const Vec3 &e1 = dip.circle.e1, &e2 = dip.circle.e2;
  dip.g = {w.squaredNorm() + f.radius * f.radius,
           2 * f.radius * w.dot(e1),
           2 * f.radius * w.dot(e2),
           w.dot(rod.axis),
           f.radius * rod.axis.dot(e1),
           f.radius * rod.axis.dot(e2),
           rod.radius,
           rod.half_height};
  dip.rod = &rod;
  dip.feature = feature;
  dip.sign = feature < 6 ? 1.0 : -1.0;
}

double depth_at(const CircleInRod& g, const Peak& peak) {
  const double z = g.z0 + g.z1 * peak.cosine + g.z2 * peak.sine;
  return depth_of(peak.value / (2.0 * g.radius),
                  (g.half_height * g.half_height - z * z) / (2.0 * g.half_height));
}

/// Looks at one circle; either it dips, or the gap says how far it is from that.
void find_dip(Dips& dips, int feature, const Feature& f) {
  const Rod& rod = *f.other;
  const Vec3 w = f.centre - rod.centre, &axis = f.owner->axis;
  const double z0 = w.dot(rod.axis), cosine = axis.dot(rod.axis);
  const double reach = f.radius * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const Vec3 rho = w - z0 * rod.axis;
  const double rho2 = rho.squaredNorm(), distance = std::sqrt(rho2), across = rho.dot(axis);
  // extent of the circle towards the rod's axis: radius sqrt(1 - (m.axis)^2), m = rho / |rho|
  const double inward = f.radius * std::sqrt(std::max(0.0, rho2 - across * across));
  const double cap_gap = std::abs(z0) - reach - rod.half_height;
  const double side_gap = distance > 0 ? distance - inward / distance - rod.radius : -rod.radius;
  if (cap_gap >= 0 || side_gap >= 0) {
    dips.gap = std::min(dips.gap, std::max(cap_gap, side_gap));
    return;
  }
  Dip& dip = dips.dip[static_cast<std::size_t>(dips.size)];
  set_dip(dip, feature, f);
  dip.peaks = positive_peaks(dip.g.side());
  if (dip.peaks.below > -1e299)
    dips.gap = std::min(dips.gap, std::sqrt(rod.radius * rod.radius - dip.peaks.below) - rod.radius);
  if (dip.peaks.size == 0) return;
  for (int i = 0; i < dip.peaks.size; ++i)
    dips.deepest = std::max(dips.deepest, depth_at(dip.g, dip.peaks.peak[static_cast<std::size_t>(i)]));
  dips.mask = static_cast<std::uint16_t>(dips.mask | (1U << feature));
  ++dips.size;
}

bool overlap(const Peak& p, const Peak& q) {
  const double apart = std::abs(std::remainder(p.phi - q.phi, 2.0 * kPi));
  return apart < std::max(p.high - p.low, q.high - q.low);
}

/// The places of last time, each followed from where it was; places of one circle stand one after the other.
/// False when one is lost.
bool follow_dips(Dips& dips, RodFeatures& features, const Rod& a, const Rod& b) {
  for (std::size_t k = 0; k < features.tracked; ++k) {
    const int feature = features.circle[k];
    const bool again = k > 0 && features.circle[k - 1] == features.circle[k];
    if (!again) {
      Dip& fresh = dips.dip[static_cast<std::size_t>(dips.size++)];
      set_dip(fresh, feature, circle_of(feature, a, b));
      fresh.peaks.size = 0;
    }
    Dip& dip = dips.dip[static_cast<std::size_t>(dips.size - 1)];
    Peak& peak = dip.peaks.peak[static_cast<std::size_t>(dip.peaks.size++)];
    if (!follow_peak(dip.g.side(), features.phi[k], peak)) return false;
    for (int i = 0; i + 1 < dip.peaks.size; ++i)  // two that have run into one another
      if (overlap(dip.peaks.peak[static_cast<std::size_t>(i)], peak)) return false;
    features.phi[k] = peak.phi;
    dips.deepest = std::max(dips.deepest, depth_at(dip.g, peak));
  }
  return true;
}

/// Where the circles touch, if there are few enough places to follow and none goes all round.
void track(const Dips& dips, RodFeatures& features) {
  features.tracked = 0;
  std::size_t n = 0;
  for (int i = 0; i < dips.size; ++i) {
    const Dip& dip = dips.dip[static_cast<std::size_t>(i)];
    for (int k = 0; k < dip.peaks.size; ++k) {
      const Peak& peak = dip.peaks.peak[static_cast<std::size_t>(k)];
      if (peak.full || n == features.phi.size()) return;
      features.circle[n] = static_cast<std::uint8_t>(dip.feature);
      features.phi[n++] = peak.phi;
    }
  }
  features.tracked = static_cast<std::uint8_t>(n);
}

/// Adds the nodes between two angles; gives what moving either of them changes in the sum.
std::pair<double, double> add_panel(TouchSum& sum, const Dip& dip, double from, double to, bool full) {
  const Circle& circle = dip.circle;
  const Rod& rod = *dip.rod;
  const double radius = circle.radius, sign = dip.sign;
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from), length = radius * half;
  ArcSums t;
  sum_arc(dip.g, middle, half, full, t);
  if (!(t.power > 0)) return {0, 0};
  // sum of x (relative to the origin of the sum) with weights k: k0 centre + radius (kc e1 + ks e2)
  const auto moment = [&](double k0, double kc, double ks) {
    return Vec3(length * (k0 * circle.centre + radius * (kc * circle.e1 + ks * circle.e2)));
  };
  const Vec3 side = moment(t.side, t.side_c, t.side_s), axial = moment(t.axial, t.axial_c, t.axial_s);
  const Vec3 force = length * (t.side * rod.centre + t.axial * rod.axis) - side;  // sum of rate * slope
  const Vec3 torque = side.cross(rod.centre) + axial.cross(rod.axis);             // sum of x cross that
  const Vec3 pressure = moment(t.rate, t.rate_c, t.rate_s);
  const Vec3 swing = radius * length * (t.rate_c * circle.e1 + t.rate_s * circle.e2);
  const Mat3 crossed = t.rate_cs * circle.e1 * circle.e2.transpose(),
             shifted = circle.centre * swing.transpose();
  const Mat3 second =
      length * (t.rate * circle.centre * circle.centre.transpose() +
                radius * radius *
                    (t.rate_cc * circle.e1 * circle.e1.transpose() + crossed + crossed.transpose() +
                     (t.rate - t.rate_cc) * circle.e2 * circle.e2.transpose())) +
      shifted + shifted.transpose();
  sum.add_sums(length * t.power, sign * force, sign * torque, length * t.rate, pressure, second, t.deepest);
  return {0.5 * (length * (t.shift - t.spread) - radius * t.power),
          0.5 * (length * (t.shift + t.spread) + radius * t.power)};
}

void add_arc(TouchSum& sum, const Dip& dip, const Arc& arc) {
  if (arc.from_root < 0) {
    add_panel(sum, dip, arc.from, arc.to, true);
    return;
  }
  const auto ends =
      over_panels(arc, [&](double from, double to) { return add_panel(sum, dip, from, to, false); });
  add_arc_end(sum, dip.circle, arc.from, arc.from_root, ends.first, *dip.rod, dip.sign);
  add_arc_end(sum, dip.circle, arc.to, arc.to_root, ends.second, *dip.rod, dip.sign);
}

/// Arcs of the circle with |z0 + z1 cos phi| < h: one, or two that mirror one another.
ArcList arcs_between_caps(const CircleInRod& g) {
  ArcList arcs;
  const double sign = g.z1 < 0 ? -1.0 : 1.0, size = std::abs(g.z1);
  const double low = (-g.half_height - sign * g.z0) / size,
               high = (g.half_height - sign * g.z0) / size;  // of sign cos
  if (!(size > 0) || (low <= -1.0 && high >= 1.0)) {
    if (std::abs(g.z0) < g.half_height) arcs.add({0, 2.0 * kPi, -1, -1});
    return arcs;
  }
  if (low >= 1.0 || high <= -1.0) return arcs;
  const double turn = sign < 0 ? kPi : 0.0;
  const double near = high >= 1.0 ? 0.0 : std::acos(high), far = low <= -1.0 ? kPi : std::acos(low);
  if (high >= 1.0)
    arcs.add({turn - far, turn + far, kCap, kCap});
  else if (low <= -1.0)
    arcs.add({turn + near, turn + 2.0 * kPi - near, kCap, kCap});
  else {
    arcs.add({turn + near, turn + far, kCap, kCap});
    arcs.add({turn - far, turn - near, kCap, kCap});
  }
  return arcs;
}

/// Whether f > 0 all along a short arc: at its ends and in its middle.
bool positive_along(const TrigQuadratic& f, const Arc& arc) {
  if (arc.from_root < 0 || arc.to - arc.from > 1.0) return false;
  for (const double phi : {arc.from, 0.5 * (arc.from + arc.to), arc.to}) {
    double s, c;
    sincos_poly(phi, s, c);
    if (f.at(c, s) <= 0) return false;
  }
  return true;
}

void add_dip(TouchSum& sum, const Dip& dip, double deepest) {
  const TrigQuadratic side = dip.g.side();
  ArcList caps, open;  // open: those that the side may cut
  const bool free = std::abs(dip.g.z0) + std::abs(dip.g.z1) <= dip.g.half_height;  // never beyond the caps
  if (!free) {
    caps = arcs_between_caps(dip.g);
    for (int i = 0; i < caps.size; ++i) {
      const Arc& arc = caps.arc[static_cast<std::size_t>(i)];
      if (positive_along(side, arc))
        add_arc(sum, dip, arc);
      else
        open.add(arc);
    }
    if (open.size == 0) return;
  }
  const double floor = kNegligible * deepest * 2.0 * dip.g.radius;
  for (int i = 0; i < dip.peaks.size; ++i) {
    const Peak& peak = dip.peaks.peak[static_cast<std::size_t>(i)];
    if (peak.value <= floor) continue;
    ArcList one;
    one.add(arc_round(side, peak, kSide));
    const ArcList both = free ? one : intersection(one, open);
    for (int k = 0; k < both.size; ++k) add_arc(sum, dip, both.arc[static_cast<std::size_t>(k)]);
  }
}

/// The sides of two crossed cylinders, at the common perpendicular of their axes. Closed form; s and t are
/// its feet on the axes. Gives the way to go before they can touch there; negative when they do.
double add_crossing(TouchSum& sum, const Rod& a, const Rod& b, double reference) {
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
  const double length = kSideLength * reference * fade * share_a * share_b, power = length * depth_power(d);
  const double rate = length * depth_power_slope(d);
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
  sum.add_sums(power, -by_w, -torque, rate, rate * x, rate * x * x.transpose(), std::min(lateral, end));
  return -1;
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
  const double norm = std::sqrt(a * a + b * b);
  slope = -(1.0 - a / norm) / radius * rho - ((1.0 - b / norm) * z / half_height) * axis;
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

Touch touch_cylinders(const Rod& a, const Rod& b, RodFeatures& features) {
  const Vec3 origin = 0.5 * (a.centre + b.centre);
  const Rod near_a{a.centre - origin, a.axis, a.radius, a.half_height};
  const Rod near_b{b.centre - origin, b.axis, b.radius, b.half_height};
  const double reference = 2.0 * kPi * std::min(a.radius, b.radius);
  TouchSum sum(origin);
  thread_local Dips dips;  // work space: several kilobytes that need no clearing
  dips.clear();
  const bool followed = features.tracked > 0 && follow_dips(dips, features, near_a, near_b);
  if (!followed) {
    dips.clear();
    for (int k = 0; k < kCrossing; ++k)
      if (features.mask >> k & 1U) find_dip(dips, k, circle_of(k, near_a, near_b));
  }
  for (int i = 0; i < dips.size; ++i) add_dip(sum, dips.dip[static_cast<std::size_t>(i)], dips.deepest);
  if (features.mask >> kCrossing & 1U) {
    const double gap = add_crossing(sum, near_a, near_b, reference);
    if (gap < 0)
      dips.mask = static_cast<std::uint16_t>(dips.mask | (1U << kCrossing));
    else
      dips.gap = std::min(dips.gap, gap);
  }
  if (!followed) {
    // a circle inside the side but beyond the caps touches nothing, and may at any moment
    if (dips.size > 0 && sum.empty()) dips.gap = 0;
    features.mask = dips.mask;
    features.gap = dips.gap;
    track(dips, features);
  }
  return sum.finish(reference, near_a.centre, near_b.centre);
}

Touch touch_cylinders(const Rod& a, const Rod& b) {
  RodFeatures all;
  return touch_cylinders(a, b, all);
}

}  // namespace packbed
