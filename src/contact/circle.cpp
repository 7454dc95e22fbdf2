#include "contact/circle.hpp"

#include <algorithm>
#include <cmath>

#include "math/simd.hpp"
#include "math/trig.hpp"

namespace packbed {
namespace {

constexpr int kSamples =
    16;  // a trigonometric quadratic has at most two maxima, never closer than a few samples
constexpr double kStep = 2.0 * kPi / kSamples;
// Half width [rad] under which the ends of an arc come from the Taylor series at its peak: right to a few
// thousandths of the arc, where d^8 has long vanished.
constexpr double kNarrow = 0.2;

struct SampleTable {
  std::array<double, kSamples> c, s;
  SampleTable() {
    for (int i = 0; i < kSamples; ++i)
      sincos_poly(2.0 * kPi * i / kSamples, s[static_cast<std::size_t>(i)], c[static_cast<std::size_t>(i)]);
  }
};
const SampleTable kTable;

/// Root of f between its maximum and a point where f <= 0: Newton, held inside the bracket by bisection.
/// Newton doubles the digits: after a step of a ten thousandth the end is right to rounding,
/// and d^8 vanishes there anyway.
double root_between(const TrigQuadratic& f, double top, double outside, double guess) {
  double x = guess, inside = top;
  for (int i = 0; i < 60; ++i) {
    double s, c;
    sincos_poly(x, s, c);
    const double value = f.at(c, s);
    (value > 0 ? inside : outside) = x;
    double next = x - value / f.slope(c, s);
    const double low = std::min(inside, outside), high = std::max(inside, outside);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-4 * std::abs(x - top)) return next;
    x = next;
  }
  return x;
}

/// Newton from peak.phi - step towards the maximum, inside [low, high].
void climb(const TrigQuadratic& f, Peak& peak, double step, double low, double high) {
  for (int i = 0; i < 12; ++i) {
    peak.phi = std::clamp(peak.phi + step, low, high);
    sincos_poly(peak.phi, peak.sine, peak.cosine);
    peak.curvature = f.curvature(peak.cosine, peak.sine);
    peak.value = f.at(peak.cosine, peak.sine);
    if (!(peak.curvature < 0)) break;
    const double rise = f.slope(peak.cosine, peak.sine);
    step = -rise / peak.curvature;
    if (std::abs(step) < 1e-3) {  // close enough for the Taylor series: the maximum to some 1e-14
      peak.third = f.third(peak.cosine, peak.sine);
      step -= peak.third * step * step / (2.0 * peak.curvature);
      peak.phi += step;
      peak.value += step * (rise + step * (0.5 * peak.curvature + step * peak.third / 6.0));
      peak.curvature += step * peak.third;
      return;
    }
  }
  peak.third = f.third(peak.cosine, peak.sine);
}

/// An angle beside a peak at which f <= 0, by walking out in steps that turn cosine and sine without a
/// library call. None within a turn: the peak's own angle. A narrow peak needs none (see arc_round).
double foot(const TrigQuadratic& f, const Peak& peak, double side) {
  if (2.0 * peak.value < -kNarrow * kNarrow * peak.curvature) return peak.phi + side * 1.5 * kNarrow;
  double c = peak.cosine, s = peak.sine;
  for (int i = 1; i < kSamples; ++i) {
    const double turned = c * kTable.c[1] - side * s * kTable.s[1];
    s = s * kTable.c[1] + side * c * kTable.s[1];
    c = turned;
    if (f.at(c, s) <= 0) return peak.phi + side * i * kStep;
  }
  return peak.phi;
}

/// The first step from the best sample, where the derivatives are known: Halley's.
double first_step(const TrigQuadratic& f, double cosine, double sine) {
  const double slope = f.slope(cosine, sine), bend = f.curvature(cosine, sine);
  const double denominator = 2.0 * bend * bend - slope * f.third(cosine, sine);
  return denominator > 0 ? -2.0 * slope * bend / denominator : 0.0;
}

PACKBED_WIDE void sample(const TrigQuadratic& f, double* value) {
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double c = kTable.c[i], s = kTable.s[i];
    value[i] = f.k0 + c * (f.k1 + f.k3 * c + f.k4 * s) + f.k2 * s;
  }
}

bool inside(const PeakList& peaks, double x) {
  for (int i = 0; i < peaks.size; ++i) {
    const Peak& p = peaks.peak[static_cast<std::size_t>(i)];
    if ((x > p.low && x < p.high) || (x - 2.0 * kPi > p.low && x - 2.0 * kPi < p.high)) return true;
  }
  return false;
}

}  // namespace

void span_plane(const Vec3& axis, const Vec3& wish, Vec3& e1, Vec3& e2) {
  e1 = wish - wish.dot(axis) * axis;
  double length2 = e1.squaredNorm();
  if (length2 < 1e-24) {
    const Vec3 other = std::abs(axis.x()) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    e1 = other - other.dot(axis) * axis;
    length2 = e1.squaredNorm();
  }
  e1 /= std::sqrt(length2);
  e2 = axis.cross(e1);
}

PeakList positive_peaks(const TrigQuadratic& f) {
  PeakList peaks;
  std::array<double, kSamples + 2> value;  // [i + 1] is sample i; the ends wrap round
  sample(f, value.data() + 1);
  value[0] = value[kSamples];
  value[kSamples + 1] = value[1];
  double lowest = value[1];
  for (double v : value) lowest = std::min(lowest, v);
  if (lowest > 0) {
    const std::size_t i =
        static_cast<std::size_t>(std::max_element(value.begin() + 1, value.end() - 1) - value.begin()) - 1;
    Peak& peak = peaks.peak[0];
    peak.phi = kStep * static_cast<double>(i);
    peak.cosine = kTable.c[i];
    peak.sine = kTable.s[i];
    peak.value = value[i + 1];
    peak.full = true;
    peaks.size = 1;
    return peaks;
  }
  const auto at = [&](int i) { return value[static_cast<std::size_t>(i + kSamples) % kSamples + 1]; };
  for (int i = 0; i < kSamples && peaks.size < 4; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const double before = value[k], here = value[k + 1], after = value[k + 2];
    if (here < before || here <= after) continue;  // only at a maximum of the samples
    const double bend = before - 2.0 * here + after, lean = before - after;
    const double top = here - 0.125 * lean * lean / bend - 0.1 * bend;  // above the true maximum
    if (bend < 0 && top <= 0) {
      peaks.below = std::max(peaks.below, top);
      continue;
    }
    Peak peak;
    peak.phi = i * kStep;
    climb(f, peak, first_step(f, kTable.c[k], kTable.s[k]), peak.phi - kStep, peak.phi + kStep);
    if (!(peak.value > 0)) {
      peaks.below = std::max(peaks.below, peak.value);
      continue;
    }
    int left = i, right = i;  // walk out to the first sample below zero on either side
    while (at(left) > 0) --left;
    while (at(right) > 0) ++right;
    if (left == i) left = peak.phi > i * kStep ? i : i - 1;
    if (right == i) right = peak.phi < i * kStep ? i : i + 1;
    peak.low = left * kStep;
    peak.high = right * kStep;
    if (!inside(peaks, peak.phi)) peaks.peak[static_cast<std::size_t>(peaks.size++)] = peak;
  }
  return peaks;
}

bool follow_peak(const TrigQuadratic& f, double phi, Peak& peak) {
  peak.phi = phi;
  peak.full = false;
  climb(f, peak, 0.0, phi - 0.2, phi + 0.2);
  if (!(peak.value > 0 && peak.curvature < 0) || std::abs(peak.phi - phi) > 0.15) return false;
  peak.low = foot(f, peak, -1.0);
  peak.high = foot(f, peak, 1.0);
  return peak.low < peak.high;
}

Arc arc_round(const TrigQuadratic& f, const Peak& peak, int name) {
  if (peak.full) return {0, 2.0 * kPi, -1, -1};
  const double top = peak.phi, reach = std::sqrt(2.0 * peak.value / std::max(1e-300, -peak.curvature));
  if (reach < kNarrow) {  // the cubic there shifts both ends of the parabola by the same way
    const double shift = -peak.third * reach * reach / (6.0 * peak.curvature);
    return {top - reach + shift, top + reach + shift, name, name};
  }
  const double from = top - reach > peak.low ? top - reach : 0.5 * (peak.low + top);
  const double to = top + reach < peak.high ? top + reach : 0.5 * (peak.high + top);
  return {root_between(f, top, peak.low, from), root_between(f, top, peak.high, to), name, name};
}

ArcList positive_arcs(const TrigQuadratic& f, int name) {
  const PeakList peaks = positive_peaks(f);
  ArcList arcs;
  for (int i = 0; i < peaks.size; ++i) arcs.add(arc_round(f, peaks.peak[static_cast<std::size_t>(i)], name));
  return arcs;
}

ArcList intersection(const ArcList& a, const ArcList& b) {
  ArcList both;
  for (int i = 0; i < a.size; ++i)
    for (int j = 0; j < b.size; ++j) {
      const Arc &p = a.arc[static_cast<std::size_t>(i)], &q = b.arc[static_cast<std::size_t>(j)];
      if (p.from_root < 0) {
        both.add(q);
        continue;
      }
      if (q.from_root < 0) {
        both.add(p);
        continue;
      }
      for (int turn = -2; turn <= 2; ++turn) {
        const double from = q.from + 2.0 * kPi * turn, to = q.to + 2.0 * kPi * turn;
        Arc arc;
        arc.from = std::max(p.from, from);
        arc.to = std::min(p.to, to);
        if (!(arc.from < arc.to)) continue;
        arc.from_root = p.from > from ? p.from_root : q.from_root;
        arc.to_root = p.to < to ? p.to_root : q.to_root;
        both.add(arc);
      }
    }
  return both;
}

}  // namespace packbed
