#pragma once
// The contact law in one picture. Every kernel measures one number, delta, and how it changes when the two
// bodies move:
//
//     W = k delta^2 / 2,   force = -dW/dq = k delta (-d delta/dq)
//
// delta is the p-norm of the pointwise depth d over the features of both bodies that dip into the other,
//
//     delta^p = (1 / L) sum_i w_i d_i^p        (w: length of rim, of line or of sampled surface; L: reference
//     length)
//
// so it is of degree one in the depth: face, edge and point touches are about equally stiff and one time step
// serves all. The depth of a point inside a body is smooth, zero on the surface and of unit slope there (see
// depth()).
#include <algorithm>
#include <cmath>

#include "math/types.hpp"

namespace packbed {

// The exponent p. Larger: stiffness more even between a flat and an edge touch (factor (L / l)^(2/p) for a
// patch of length l), but the force follows the deepest point more sharply, and a flat touch is (p - 1) / 2
// times stiffer against rocking than against a push.
/// Of kernels that integrate along curves.
inline constexpr int kCurveExponent = 16;
/// Of kernels that add up points: a larger one would feel each of them.
inline constexpr int kPointExponent = 8;

// Real: double, or a vector of doubles of the compiler's.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif
/// d^p
template <int kExponent, class Real>
inline __attribute__((always_inline)) Real depth_power(const Real& d) {
  const Real d2 = d * d, d4 = d2 * d2, d8 = d4 * d4;
  if constexpr (kExponent == 16) return d8 * d8;
  static_assert(kExponent == 8 || kExponent == 16);
  return d8;
}
/// p d^(p - 1)
template <int kExponent, class Real>
inline __attribute__((always_inline)) Real depth_power_slope(const Real& d) {
  const Real d2 = d * d, d4 = d2 * d2, d7 = d4 * d2 * d;
  if constexpr (kExponent == 16) return 16.0 * (d4 * d4) * d7;
  static_assert(kExponent == 8 || kExponent == 16);
  return 8.0 * d7;
}
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

/// What a kernel says of two bodies. Gradients are per unit of k delta: force on a = k delta gradient, and
/// minus that on b.
struct Touch {
  double delta = 0;              // [m]; 0: apart, and nothing else is set
  Vec3 gradient = Vec3::Zero();  // -d delta / d position of a [-]
  Vec3 torque_a = Vec3::Zero();  // -d delta / d rotation of a, about a's centre [m]
  Vec3 torque_b = Vec3::Zero();  // the same of b, about b's centre [m]
  Vec3 point = Vec3::Zero();     // centre of pressure, world [m]
  double patch_radius = 0;       // root mean square distance of the pressure from `point` [m]
  Mat3 patch = Mat3::Zero();     // second moment of the pressure about `point` [m2]
  double depth = 0;  // greatest distance of any feature point from the surface that it dips through [m]
  double share =
      1;  // of the pair's stiffness, when the pair touches in several patches (contact/patches.hpp)
};

/// Sum of the rates w p d^(p - 1) of points x, of rate x, and of rate x x^T.
struct Pressure {
  double total = 0;
  Vec3 x = Vec3::Zero();
  Mat3 xx = Mat3::Zero();
};

/// Gathers weighted depths into a Touch. Works about an origin near both bodies so that torques lose no
/// digits.
template <int kExponent>
class TouchSum {
 public:
  explicit TouchSum(const Vec3& origin) : origin_(origin) {}

  /// A point x (relative to the origin) of depth d and weight w; `slope` is d depth / d x of a's point in b
  /// (or minus that of b's in a): moving a by dx changes the depth by slope . dx.
  void add(const Vec3& x, double d, double w, const Vec3& slope) {
    const double power = w * depth_power<kExponent>(d), rate = w * depth_power_slope<kExponent>(d);
    sum_ += power;
    force_ -= rate * slope;
    torque_ -= rate * x.cross(slope);
    centre_ += rate * x;
    second_ += rate * x * x.transpose();
    pressure_ += rate;
    if (d > depth_) depth_ = d;
  }
  /// Sums that a kernel has made itself: of w d^p, of rate * slope and its torque, of the pressure.
  void add_sums(double power, const Vec3& rate_slope, const Vec3& torque, const Pressure& pressure,
                double deepest) {
    sum_ += power;
    force_ -= rate_slope;
    torque_ -= torque;
    pressure_ += pressure.total;
    centre_ += pressure.x;
    second_ += pressure.xx;
    depth_ = std::max(depth_, deepest);
  }
  bool empty() const { return !(sum_ > 0); }

  /// L: reference length of the pair [m]; centres of the bodies relative to the origin.
  Touch finish(double reference, const Vec3& centre_a, const Vec3& centre_b) const {
    Touch touch;
    if (empty()) return touch;
    touch.delta = std::sqrt(std::sqrt(std::sqrt(sum_ / reference)));  // the 1/8-th power
    if constexpr (kExponent == 16) touch.delta = std::sqrt(touch.delta);
    // d delta = d sum / (p sum) delta
    const double factor = touch.delta / (kExponent * sum_);
    touch.gradient = factor * force_;
    const Vec3 torque = factor * torque_;
    touch.torque_a = torque - centre_a.cross(touch.gradient);
    touch.torque_b = -torque + centre_b.cross(touch.gradient);
    const Vec3 centre = centre_ / pressure_;
    touch.point = origin_ + centre;
    touch.patch = second_ / pressure_ - centre * centre.transpose();
    touch.patch_radius = std::sqrt(std::max(0.0, touch.patch.trace()));
    touch.depth = depth_;
    return touch;
  }

 private:
  Vec3 origin_;
  double sum_ = 0, pressure_ = 0, depth_ = 0;
  Mat3 second_ = Mat3::Zero();
  Vec3 force_ = Vec3::Zero(), torque_ = Vec3::Zero(), centre_ = Vec3::Zero();
};

}  // namespace packbed
