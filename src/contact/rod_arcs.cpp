#include "contact/rod_arcs.hpp"

#include <cmath>

#include "math/simd.hpp"
#include "math/trig.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif
#define PACKBED_INLINE inline __attribute__((always_inline))

namespace packbed {
namespace {

constexpr int kNodes = 8;
constexpr std::array<double, kNodes> kGaussNode = {
    -0.96028985649753623168, -0.79666647741362673959, -0.52553240991632898582, -0.18343464249564980494,
    0.18343464249564980494,  0.52553240991632898582,  0.79666647741362673959,  0.96028985649753623168};
constexpr std::array<double, kNodes> kGaussWeight = {
    0.10122853629037625915, 0.22238103445337447054, 0.31370664587788728734, 0.36268378337836198297,
    0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054, 0.10122853629037625915};
// A full turn is summed at evenly spaced nodes, eight a half.
constexpr double kEvenWeight = 2.0 / kNodes;
constexpr double even_node(int k) {
  return (2.0 * k + 1.0) / kNodes - 1.0;
}

// Last step of Newton's method, fraction of the arc, under which an end counts as found: the error is of the
// order of its square.
constexpr double kFound = 0.02;

PACKBED_INLINE Lanes root_of(const Lanes& v) {
  Lanes out;
  for (int i = 0; i < kLanes; ++i) out[i] = std::sqrt(v[i]);
  return out;
}
PACKBED_INLINE Lanes positive(const Lanes& v) {
  return v > 0.0 ? v : Lanes{};
}
PACKBED_INLINE Lanes least(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}
PACKBED_INLINE Lanes size_of(const Lanes& v) {
  return v < 0.0 ? -v : v;
}
PACKBED_INLINE Lanes dot(const LaneVec& a, const LaneVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
PACKBED_INLINE LaneVec cross(const LaneVec& a, const LaneVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
PACKBED_INLINE LaneVec times(const Lanes& k, const LaneVec& v) {
  return {k * v.x, k * v.y, k * v.z};
}
PACKBED_INLINE LaneVec plus(const LaneVec& a, const LaneVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

PACKBED_INLINE Lanes to_fifteenth(const Lanes& v) {
  static_assert(kEdgeSharpness == 16);
  const Lanes v2 = v * v, v4 = v2 * v2;
  return v4 * v4 * v4 * v2 * v;
}

/// The circle in the frame of the cylinder: z the height over its middle, y2 the square of the distance.
struct Track {
  Lanes z0, z1, z2, y0, p, q, radius2, height2;
  Lanes z, z_dot, y2, y2_dot;  // at the angle last asked for

  PACKBED_INLINE void go_to(const Lanes& s, const Lanes& c) {
    z = z0 + z1 * c + z2 * s;
    z_dot = z2 * c - z1 * s;
    y2 = y0 + p * c + q * s;
    y2_dot = q * c - p * s;
  }
  PACKBED_INLINE Lanes side() const { return radius2 - y2 + z * z; }  // > 0 inside
  PACKBED_INLINE Lanes side_dot() const { return 2.0 * z * z_dot - y2_dot; }
  PACKBED_INLINE Lanes cap() const { return height2 - z * z; }
  PACKBED_INLINE Lanes cap_dot() const { return -2.0 * z * z_dot; }
};

struct End {
  Lanes s, c;         // sine and cosine of its angle
  Lanes last, other;  // last step of Newton's method; the condition that does not end the arc, > 0 inside
  Lanes slope;        // of the depth along the circle [m/rad]
  Lanes cap, z;
};

PACKBED_INLINE void newton(Track& t, const Lanes& cap, const Lanes& keep, Lanes& angle, End& end) {
  sincos_poly(angle, end.s, end.c);
  t.go_to(end.s, end.c);
  const Lanes value = cap > 0.0 ? t.cap() : t.side(), slope = cap > 0.0 ? t.cap_dot() : t.side_dot();
  end.last = keep * (slope != 0.0 ? value / slope : value);
  angle -= end.last;
}

PACKBED_INLINE End find_end(Track& t, const RodArcBatch& b, const Lanes& cap, const Lanes& keep,
                            Lanes& angle) {
  End end;
  newton(t, cap, keep, angle, end);
  newton(t, cap, keep, angle, end);
  sincos_poly(angle, end.s, end.c);
  t.go_to(end.s, end.c);
  end.other = cap > 0.0 ? t.side() : t.cap();
  end.slope = cap > 0.0 ? t.cap_dot() / (2.0 * b.half_height) : t.side_dot() / (2.0 * b.rod_radius);
  end.cap = cap;
  end.z = t.z;
  return end;
}

/// The end moves with the bodies, and the nodes with it: `rate` is what that changes in the sum.
PACKBED_INLINE void add_end(const RodArcBatch& b, const End& end, const LaneVec& e1, const LaneVec& e2,
                            const Lanes& rate, LaneVec& force, LaneVec& torque) {
  const LaneVec y = plus(b.centre, times(b.radius, plus(times(end.c, e1), times(end.s, e2))));
  // slope of the depth there: -(y - z axis) / R in the side, -z / h axis in a cap
  const Lanes by_y = end.cap > 0.0 ? Lanes{} : -1.0 / b.rod_radius;
  const Lanes by_axis = end.cap > 0.0 ? -end.z / b.half_height : end.z / b.rod_radius;
  const Lanes steep = size_of(end.slope) - 1e-12 * b.radius;  // a touch that has only just begun has none
  const Lanes k = steep > 0.0 ? -rate / end.slope : Lanes{};
  force = plus(force, plus(times(k * by_y, y), times(k * by_axis, b.axis)));
  torque = plus(torque, times(k * by_axis, cross(y, b.axis)));
}

PACKBED_INLINE void put(RodArcBatch& b, ArcSum first, const LaneVec& v) {
  b.sum[first] = v.x;
  b.sum[first + 1] = v.y;
  b.sum[first + 2] = v.z;
}

/// The sum of rate x x^T over points x = c + y, where sum rate y = swing and sum rate y y^T = e1 along1^T +
/// e2 along2^T; x sums up to `total`.
struct SecondMoment {
  const LaneVec &c, &total, &swing, &e1, &along1, &e2, &along2;

  PACKBED_INLINE Lanes at(Lanes LaneVec::*i, Lanes LaneVec::*j) const {
    return c.*i * total.*j + swing.*i * c.*j + e1.*i * along1.*j + e2.*i * along2.*j;
  }
};

}  // namespace

PACKBED_WIDE void follow(RodArcBatch& b) {
  const Lanes one = Lanes{} + 1.0;
  LaneVec e1 = plus(b.wish, times(-dot(b.wish, b.owner), b.owner));
  e1 = times(1.0 / root_of(dot(e1, e1)), e1);
  const LaneVec e2 = cross(b.owner, e1);
  Track t;
  t.z0 = dot(b.centre, b.axis);
  t.z1 = b.radius * dot(e1, b.axis);
  t.z2 = b.radius * dot(e2, b.axis);
  t.y0 = dot(b.centre, b.centre) + b.radius * b.radius;
  t.p = 2.0 * b.radius * dot(b.centre, e1);
  t.q = 2.0 * b.radius * dot(b.centre, e2);
  t.radius2 = b.rod_radius * b.rod_radius;
  t.height2 = b.half_height * b.half_height;

  const Lanes keep = one - b.full;
  const End from = find_end(t, b, b.from_cap, keep, b.from), to = find_end(t, b, b.to_cap, keep, b.to);
  const Lanes length = b.to - b.from;
  const Lanes ends_hold = length > 0.0 && length < 2.0 * kPi && size_of(from.last) < kFound * length &&
                                  size_of(to.last) < kFound * length && from.other > 0.0 && to.other > 0.0
                              ? one
                              : Lanes{};

  const Lanes per_radius = 1.0 / b.rod_radius, per_height = 1.0 / b.half_height;
  const Lanes cosine = dot(b.owner, b.axis), sine2 = one - cosine * cosine;
  Lanes power{}, edge{}, rate{}, rate_c{}, rate_s{}, rate_cc{}, rate_cs{}, side{}, side_c{}, side_s{},
      axial{}, axial_c{}, axial_s{}, by_from{}, by_to{}, deepest{}, shallowest = Lanes{} + 1e300;
  for (int k = 0; k < kNodes; ++k) {
    const std::size_t n = static_cast<std::size_t>(k);
    const Lanes xi = b.full > 0.0 ? Lanes{} + even_node(k) : Lanes{} + kGaussNode[n];
    const Lanes w = 0.5 * b.span * (b.full > 0.0 ? Lanes{} + kEvenWeight : Lanes{} + kGaussWeight[n]);
    const Lanes place = b.part + 0.5 * b.span * (xi + 1.0);  // fraction of the arc
    Lanes s, c;
    sincos_poly(b.from + length * place, s, c);
    t.go_to(s, c);
    const Lanes in_side = positive(0.5 * per_radius * t.side()),
                in_cap = positive(0.5 * per_height * t.cap());
    const Lanes wide = one - 2.0 * in_side * per_radius, high = one - 2.0 * in_cap * per_height;
    // depth = a + b - (a^4 + b^4)^(1/4)
    const Lanes side2 = in_side * in_side, cap2 = in_cap * in_cap;
    const Lanes norm2 = root_of(side2 * side2 + cap2 * cap2), norm = root_of(norm2) + 1e-300;
    const Lanes per_norm3 = 1.0 / (norm * norm * norm + 1e-300), d = positive(in_side + in_cap - norm);
    const Lanes slope_side = 1.0 - side2 * in_side * per_norm3, slope_cap = 1.0 - cap2 * in_cap * per_norm3;
    const Lanes near = kEdgeWeight * to_fifteenth(wide * high), more = near * wide * high;
    const Lanes even = w * depth_power<kCurveExponent>(d), p = even * (one + sine2 * more);
    const Lanes r = w * depth_power_slope<kCurveExponent>(d) * (one + sine2 * more);
    const Lanes near_slope = 2.0 * kEdgeSharpness * sine2 * even * near;
    const Lanes r_side = (r * slope_side - near_slope * high * per_radius) * per_radius,
                r_cap = (r * slope_cap - near_slope * wide * per_height) * per_height;
    const Lanes along = 0.5 * (r_side * t.side_dot() + r_cap * t.cap_dot()) * length;
    const Lanes r_axial = (r_side - r_cap) * t.z;
    power += p;
    edge += even * more;
    by_from += along * (1.0 - place) - p;
    by_to += along * place + p;
    rate += r;
    rate_c += r * c;
    rate_s += r * s;
    rate_cc += r * c * c;
    rate_cs += r * c * s;
    side += r_side;
    side_c += r_side * c;
    side_s += r_side * s;
    axial += r_axial;
    axial_c += r_axial * c;
    axial_s += r_axial * s;
    const Lanes depth = least(in_side, in_cap);
    deepest = depth > deepest ? depth : deepest;
    shallowest = least(shallowest, depth);
  }
  b.holds = shallowest > 0.0 ? (b.full > 0.0 ? one : ends_hold) : Lanes{};
  b.deepest = deepest;

  const Lanes l = b.radius * length, lr = l * b.radius;  // angle between nodes to length
  b.sum[kPower] = l * power;
  const LaneVec swing_side = plus(times(side_c, e1), times(side_s, e2));
  LaneVec force = plus(times(-l * side, b.centre), plus(times(-lr, swing_side), times(l * axial, b.axis)));
  const LaneVec lever =
      plus(times(l * axial, b.centre), times(lr, plus(times(axial_c, e1), times(axial_s, e2))));
  LaneVec torque = cross(plus(lever, times(-2.0 * l * cosine * edge, b.owner)), b.axis);
  add_end(b, from, e1, e2, keep * b.radius * by_from, force, torque);
  add_end(b, to, e1, e2, keep * b.radius * by_to, force, torque);
  put(b, kForceX, times(b.sign, force));
  put(b, kTorqueX, times(b.sign, plus(torque, cross(b.origin, force))));

  const Lanes pressure = l * rate;
  const LaneVec swing = times(lr, plus(times(rate_c, e1), times(rate_s, e2)));
  const LaneVec along1 = times(lr * b.radius, plus(times(rate_cc, e1), times(rate_cs, e2)));
  const LaneVec along2 = times(lr * b.radius, plus(times(rate_cs, e1), times(rate - rate_cc, e2)));
  const LaneVec centre = plus(b.origin, b.centre), total = plus(times(pressure, centre), swing);
  b.sum[kPressure] = pressure;
  put(b, kPressureX, total);
  const SecondMoment second{centre, total, swing, e1, along1, e2, along2};
  b.sum[kXX] = second.at(&LaneVec::x, &LaneVec::x);
  b.sum[kYY] = second.at(&LaneVec::y, &LaneVec::y);
  b.sum[kZZ] = second.at(&LaneVec::z, &LaneVec::z);
  b.sum[kXY] = second.at(&LaneVec::x, &LaneVec::y);
  b.sum[kXZ] = second.at(&LaneVec::x, &LaneVec::z);
  b.sum[kYZ] = second.at(&LaneVec::y, &LaneVec::z);
}

}  // namespace packbed
