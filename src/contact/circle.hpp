#pragma once
// A circle in space and the arcs of it on which a quadratic of the position is positive: the rims of a
// cylinder dipping into another cylinder, through a floor or into the wall of a tube.
#include <array>

#include "contact/touch.hpp"

namespace packbed {

struct Circle {
  Vec3 centre = Vec3::Zero();                   // [m]
  Vec3 e1 = Vec3::UnitX(), e2 = Vec3::UnitY();  // unit vectors that span its plane; point(phi) = centre +
                                                // radius (e1 cos phi + e2 sin phi)
  double radius = 0;                            // [m]

  Vec3 point(double cosine, double sine) const { return centre + radius * (cosine * e1 + sine * e2); }
};

/// Two unit vectors perpendicular to `axis`; the first as close as possible to `wish`.
void span_plane(const Vec3& axis, const Vec3& wish, Vec3& e1, Vec3& e2);

/// f(phi) = k0 + k1 cos phi + k2 sin phi + k3 cos^2 phi + k4 sin phi cos phi
struct TrigQuadratic {
  double k0 = 0, k1 = 0, k2 = 0, k3 = 0, k4 = 0;

  double at(double c, double s) const { return k0 + c * (k1 + k3 * c + k4 * s) + k2 * s; }
  double slope(double c, double s) const {
    return -s * k1 + c * k2 - 2.0 * k3 * s * c + k4 * (c * c - s * s);
  }
  double third(double c, double s) const {
    return s * k1 - c * k2 + 8.0 * k3 * s * c - 4.0 * k4 * (c * c - s * s);
  }
  double curvature(double c, double s) const {
    return -c * k1 - s * k2 - 2.0 * k3 * (c * c - s * s) - 4.0 * k4 * s * c;
  }
};

/// Angles on which a circle touches; `full`: all round.
struct Arc {
  double from = 0, to = 2.0 * kPi;  // radians, from < to <= from + 2 pi
  bool full = false;
  int from_name = 0, to_name = 0;  // of the list that set the end, for intersections: 0 or 1
};

struct ArcList {
  std::array<Arc, 8> arc;
  int size = 0;
  void add(const Arc& a) {
    if (size < 8) arc[static_cast<std::size_t>(size++)] = a;
  }
};

/// A maximum of a TrigQuadratic where it is positive, with a bracket that holds both ends of its arc.
struct Peak {
  double phi = 0, cosine = 1, sine = 0;        // where it is
  double value = 0, curvature = 0, third = 0;  // f, f'' and f''' there
  double low = 0, high = 0;                    // angles with f <= 0 on either side; no use when `full`
  bool full = false;                           // positive all round
};

struct PeakList {
  std::array<Peak, 2> peak;
  int size = 0;
  double below = -1e300;  // greatest maximum that stays below zero, if any
  // of a lone maximum: amplitude of the first harmonic over four times that of the second, by which f is safe
  // from having another; without bound where there are two
  double lone = 1e300;
};

/// All peaks above zero; two that no valley below zero parts are one.
PeakList positive_peaks(const TrigQuadratic& f);
/// Step of Newton's method, fraction of the half arc, after which the end of an arc is good enough: for a sum
/// of d^16 that does not reach 1e-16 of its size in the last twentieth of the arc; for an arc that is to be
/// cut.
inline constexpr double kWholeArc = 0.05, kCutArc = 2e-3;
/// The arc round a peak on which f > 0, its ends to the tolerance.
Arc arc_round(const TrigQuadratic& f, const Peak& peak, double tolerance);
/// Arcs that belong to both lists; ends keep the names that they have there.
ArcList intersection(const ArcList& a, const ArcList& b);

/// Number of evenly spaced nodes on an arc against a wall, where the depth is smooth: d^16 and its first
/// fifteen derivatives vanish at both ends, and on a full turn it is periodic: there is no better rule for
/// either, it does not care where exactly the ends are, and so neither does the gradient.
inline constexpr int kArcNodes = 16;
inline constexpr std::array<double, kArcNodes> kArcNode = [] {
  std::array<double, kArcNodes> node{};
  for (int i = 0; i < kArcNodes; ++i) node[static_cast<std::size_t>(i)] = (2.0 * i + 1.0) / kArcNodes - 1.0;
  return node;
}();

/// Terms of several sums over the nodes of an arc, added up in an order that does not depend on how wide the
/// machine's vectors are.
template <std::size_t kSums>
struct ArcTerms {
  static_assert(kArcNodes == 16);
  std::array<std::array<double, kArcNodes>, kSums> term;

  double sum(std::size_t k) const {
    const std::array<double, kArcNodes>& v = term[k];
    const double a = (v[0] + v[8]) + (v[4] + v[12]), b = (v[1] + v[9]) + (v[5] + v[13]);
    const double c = (v[2] + v[10]) + (v[6] + v[14]), d = (v[3] + v[11]) + (v[7] + v[15]);
    return (a + b) + (c + d);
  }
  double largest(std::size_t k) const {
    double most = 0;
    for (double v : term[k]) most = v > most ? v : most;
    return most;
  }
};

/// Sums of d^16 and of its slope 16 d^15 with the cosine and sine of the angle, times the angle between
/// nodes.
struct ArcSums {
  double power = 0, rate = 0, rate_c = 0, rate_s = 0, rate_cc = 0, rate_cs = 0;
  double deepest = 0;
};
/// Over one arc, of the depth f.
void sum_arc(const TrigQuadratic& f, const Arc& arc, ArcSums& out);
/// Of the points of a circle.
Pressure pressure_of(const Circle& circle, const ArcSums& sums);

}  // namespace packbed
