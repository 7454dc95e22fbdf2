#pragma once
// A circle in space and the arcs of it on which a quadratic of the position is positive: the rims of a
// cylinder dipping into another cylinder, through a floor or into the wall of a tube.
#include <array>
#include <utility>

#include "math/types.hpp"

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

struct Arc {
  double from = 0, to = 0;           // radians, from < to <= from + 2 pi
  int from_root = -1, to_root = -1;  // which quadratic vanishes at the end; -1: none (a full turn)
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
  std::array<Peak, 4> peak;
  int size = 0;
  double below = -1e300;  // greatest maximum that stays below zero, if any
};

/// All peaks above zero. A full turn is one peak, at the largest sample.
PeakList positive_peaks(const TrigQuadratic& f);
/// Follows the peak of an earlier look that was at `phi` then. False when it has gone below zero, or too far
/// to be sure.
bool follow_peak(const TrigQuadratic& f, double phi, Peak& peak);
/// The arc round a peak on which f > 0; `name` is stored as the root of its ends.
Arc arc_round(const TrigQuadratic& f, const Peak& peak, int name);
/// Arcs on which f > 0.
ArcList positive_arcs(const TrigQuadratic& f, int name);
/// Arcs that belong to both lists.
ArcList intersection(const ArcList& a, const ArcList& b);

/// Nodes and weights of the Gauss-Legendre rule on [-1, 1] that all arcs use.
inline constexpr int kArcNodes = 12;
inline constexpr std::array<double, kArcNodes> kGaussNode = {
    -0.98156063424671925069, -0.90411725637047485668, -0.76990267419430468704, -0.58731795428661744730,
    -0.36783149899818019375, -0.12523340851146891547, 0.12523340851146891547,  0.36783149899818019375,
    0.58731795428661744730,  0.76990267419430468704,  0.90411725637047485668,  0.98156063424671925069};
inline constexpr std::array<double, kArcNodes> kGaussWeight = {
    0.04717533638651182719, 0.10693932599531843096, 0.16007832854334622633, 0.20316742672306592174,
    0.23349253653835480876, 0.24914704581340278500, 0.24914704581340278500, 0.23349253653835480876,
    0.20316742672306592174, 0.16007832854334622633, 0.10693932599531843096, 0.04717533638651182719};

/// Evenly spaced nodes on [-1, 1] for a full turn.
inline constexpr std::array<double, kArcNodes> kEvenNode = [] {
  std::array<double, kArcNodes> node{};
  for (int i = 0; i < kArcNodes; ++i) node[static_cast<std::size_t>(i)] = (2.0 * i + 1.0) / kArcNodes - 1.0;
  return node;
}();

inline constexpr std::array<double, kArcNodes> kEvenWeight = [] {
  std::array<double, kArcNodes> weight{};
  for (double& w : weight) w = 2.0 / kArcNodes;
  return weight;
}();

/// Half width [rad] from which an arc is integrated in two halves: one rule alone would be off by up to 1e-3
/// on a whole turn.
inline constexpr double kWideArc = 1.0;

/// panel(from, to) over an arc, or over its two halves when it is wide; gives what moving the ends of the arc
/// changes in the sum, the middle going along.
template <class Panel>
std::pair<double, double> over_panels(const Arc& arc, const Panel& panel) {
  if (arc.to - arc.from <= 2.0 * kWideArc) return panel(arc.from, arc.to);
  const double middle = 0.5 * (arc.from + arc.to);
  const auto first = panel(arc.from, middle), second = panel(middle, arc.to);
  const double shared = 0.5 * (first.second + second.first);
  return {first.first + shared, second.second + shared};
}

}  // namespace packbed
