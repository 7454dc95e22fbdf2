#include "contact/circle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/simd.hpp"
#include "math/trig.hpp"

namespace packbed {
namespace {

constexpr int kSamples = 16;  // of a trigonometric quadratic, which has at most two maxima
constexpr double kStep = 2.0 * kPi / kSamples;
// Two maxima may lie within a step of one sample. A top is then flat: its curvature is below this fraction of
// what the harmonics could give. Such a top is sampled this many times more finely.
constexpr double kFlat = 0.2;
constexpr int kFiner = 8;
// Half width [rad] under which the ends of an arc come from the Taylor series at its peak: right to a few
// thousandths of the arc, where d^16 has long vanished.
constexpr double kNarrow = 0.2;
// Newton's step towards a maximum that is the last one taken [rad].
constexpr double kPeakTolerance = 0.05;

struct SampleTable {
  std::array<double, kSamples> c, s;
  SampleTable() {
    for (int i = 0; i < kSamples; ++i)
      sincos_poly(2.0 * kPi * i / kSamples, s[static_cast<std::size_t>(i)], c[static_cast<std::size_t>(i)]);
  }
};
const SampleTable kTable;

using Samples = std::array<double, kSamples + 2>;  // [i + 1] is sample i; the ends wrap round

/// Root of f between its maximum and a point where f <= 0: Newton, held inside the bracket by bisection.
double root_between(const TrigQuadratic& f, double top, double outside, double guess, double tolerance) {
  double x = guess, inside = top;
  for (int i = 0; i < 30; ++i) {
    double s, c;
    sincos_poly(x, s, c);
    const double value = f.at(c, s);
    (value > 0 ? inside : outside) = x;
    double next = x - value / f.slope(c, s);
    const double low = std::min(inside, outside), high = std::max(inside, outside);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= tolerance * std::abs(x - top)) return next;
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
    if (std::abs(step) < kPeakTolerance) {  // the rest by the Taylor series
      peak.third = f.third(peak.cosine, peak.sine);
      step -= peak.third * step * step / (2.0 * peak.curvature);
      peak.phi += step;
      peak.value += step * (rise + step * (0.5 * peak.curvature + step * peak.third / 6.0));
      peak.curvature += step * peak.third;
      sincos_poly(peak.phi, peak.sine, peak.cosine);  // the feet are walked to from there
      return;
    }
  }
  peak.third = f.third(peak.cosine, peak.sine);
}

/// An angle beside a peak at which f <= 0, by walking out in steps that turn cosine and sine without a
/// library call. None within a turn: the peak's own angle. A narrow peak has its feet near by.
double foot(const TrigQuadratic& f, const Peak& peak, double side) {
  double c = 0, s = 0;
  if (2.0 * peak.value < -kNarrow * kNarrow * peak.curvature) {
    const double near = peak.phi + side * 1.5 * kNarrow;
    sincos_poly(near, s, c);
    if (f.at(c, s) <= 0) return near;  // else it is flat on top
  }
  c = peak.cosine;
  s = peak.sine;
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

/// Sets the bracket of a peak that has no other above zero beside it.
void set_feet(const TrigQuadratic& f, Peak& peak) {
  peak.low = foot(f, peak, -1.0);
  peak.high = foot(f, peak, 1.0);
  peak.full = peak.low == peak.phi || peak.high == peak.phi;  // or all round but for a few degrees
}

PeakList single_peak(const TrigQuadratic& f) {
  PeakList peaks;
  Peak& peak = peaks.peak[0];
  peak.phi = std::atan2(f.k2, f.k1);
  climb(f, peak, 0.0, peak.phi - 1.0, peak.phi + 1.0);
  if (peak.value > 0) {
    peaks.size = 1;
    set_feet(f, peak);
  } else {
    peaks.below = peak.value;
  }
  return peaks;
}

/// A place between two maxima where f is not above zero, or else its lowest place; and whether it is above.
std::pair<double, bool> valley(const TrigQuadratic& f, const Samples& value, double from, double to) {
  for (double i = std::ceil(from / kStep); i * kStep < to; ++i)
    if (!(value[static_cast<std::size_t>(static_cast<int>(i) + 2 * kSamples) % kSamples + 1] > 0))
      return {i * kStep, false};
  double s = 0, c = 1;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (from + to);
    sincos_poly(middle, s, c);
    (f.slope(c, s) < 0 ? from : to) = middle;
  }
  return {0.5 * (from + to), f.at(c, s) > 0};
}

/// Two maxima above zero: two arcs, one that holds both, or a full turn.
void part_or_join(const TrigQuadratic& f, const Samples& value, PeakList& peaks) {
  Peak &p = peaks.peak[0], &q = peaks.peak[1];  // p.phi < q.phi
  const auto [inner, above_inner] = valley(f, value, p.phi, q.phi);
  const auto [outer, above_outer] = valley(f, value, q.phi, p.phi + 2.0 * kPi);
  p.low = outer - 2.0 * kPi;
  p.high = q.low = inner;
  q.high = outer;
  if (!above_inner && !above_outer) return;
  peaks.size = 1;
  p.full = above_inner && above_outer;
  if (above_outer) {  // joined over the turn of the angle
    p.low = inner - 2.0 * kPi;
    p.high = inner;
  } else {
    p.high = outer;
  }
}

void add_peak(PeakList& peaks, const Peak& peak) {
  if (peak.value > 0 && peaks.size < 2)
    peaks.peak[static_cast<std::size_t>(peaks.size++)] = peak;
  else
    peaks.below = std::max(peaks.below, peak.value);
}

/// Both maxima, where there are two, within a step of a sample.
void add_close_peaks(const TrigQuadratic& f, double middle, PeakList& peaks) {
  const auto at = [&](int i) {
    double s, c;
    sincos_poly(middle + i * (kStep / kFiner), s, c);
    return f.at(c, s);
  };
  double before = at(-kFiner), here = at(1 - kFiner);
  for (int i = 1 - kFiner; i < kFiner; ++i) {
    const double after = at(i + 1);
    if (here > before && here >= after) {
      Peak peak;
      peak.phi = middle + i * (kStep / kFiner);
      climb(f, peak, 0.0, peak.phi - kStep / kFiner, peak.phi + kStep / kFiner);
      add_peak(peaks, peak);
    }
    before = here;
    here = after;
  }
}

PeakList sampled_peaks(const TrigQuadratic& f) {
  PeakList peaks;
  Samples value;
  sample(f, value.data() + 1);
  value[0] = value[kSamples];
  value[kSamples + 1] = value[1];
  // how far f may lie above the parabola through three samples: 2 / (3 sqrt 3) h^3 / 6 times its third
  // derivative
  const double first = std::hypot(f.k1, f.k2), second = std::hypot(f.k3, f.k4);
  const double bow = 0.0642 * kStep * kStep * kStep * (first + 4.0 * second);
  for (int i = 0; i < kSamples && peaks.size < 2; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const double before = value[k], here = value[k + 1], after = value[k + 2];
    if (here < before || here <= after) continue;  // only at a maximum of the samples
    const double bend = before - 2.0 * here + after, lean = before - after;
    const double top = here - 0.125 * lean * lean / bend + bow;  // above the true maximum
    if (bend < 0 && top <= 0) {
      peaks.below = std::max(peaks.below, top);
      continue;
    }
    Peak peak;
    peak.phi = i * kStep;
    climb(f, peak, first_step(f, kTable.c[k], kTable.s[k]), peak.phi - kStep, peak.phi + kStep);
    if (peak.curvature < -kFlat * (first + 2.0 * second))
      add_peak(peaks, peak);
    else
      add_close_peaks(f, i * kStep, peaks);
  }
  if (peaks.size == 0 && value[1] > 0) {  // the same all round
    peaks.size = 1;
    peaks.peak[0].value = value[1];
    peaks.peak[0].full = true;
    return peaks;
  }
  if (peaks.size == 1) set_feet(f, peaks.peak[0]);
  if (peaks.size == 2) part_or_join(f, value, peaks);
  return peaks;
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
  // with little of the second harmonic there is one maximum, near that of the first
  const double spare = std::hypot(f.k1, f.k2) - 2.0 * std::hypot(f.k3, f.k4);
  PeakList peaks = spare > 0 ? single_peak(f) : sampled_peaks(f);
  if (spare > 0)
    peaks.lone = spare;
  else if (peaks.size == 1 && peaks.below < -1e299)
    peaks.lone = 0;
  return peaks;
}

Arc arc_round(const TrigQuadratic& f, const Peak& peak, double tolerance) {
  if (peak.full) return {0, 2.0 * kPi, true};
  const double top = peak.phi, reach = std::sqrt(2.0 * peak.value / std::max(1e-300, -peak.curvature));
  if (reach < kNarrow &&
      tolerance >= kWholeArc) {  // the cubic there shifts both ends of the parabola by the same way
    const double shift = -peak.third * reach * reach / (6.0 * peak.curvature);
    return {top - reach + shift, top + reach + shift};
  }
  const double from = top - reach > peak.low ? top - reach : 0.5 * (peak.low + top);
  const double to = top + reach < peak.high ? top + reach : 0.5 * (peak.high + top);
  return {root_between(f, top, peak.low, from, tolerance), root_between(f, top, peak.high, to, tolerance)};
}

ArcList intersection(const ArcList& a, const ArcList& b) {
  ArcList both;
  for (int i = 0; i < a.size; ++i)
    for (int j = 0; j < b.size; ++j) {
      const Arc &p = a.arc[static_cast<std::size_t>(i)], &q = b.arc[static_cast<std::size_t>(j)];
      if (p.full || q.full) {
        both.add(p.full ? q : p);
        continue;
      }
      for (int turn = -2; turn <= 2; ++turn) {
        const double from = q.from + 2.0 * kPi * turn, to = q.to + 2.0 * kPi * turn;
        const Arc arc{std::max(p.from, from), std::min(p.to, to), false,
                      p.from > from ? p.from_name : q.from_name, p.to < to ? p.to_name : q.to_name};
        if (arc.from < arc.to) both.add(arc);
      }
    }
  return both;
}

PACKBED_WIDE void sum_arc(const TrigQuadratic& f, const Arc& arc, ArcSums& out) {
  ArcTerms<7> t;
  const double middle = 0.5 * (arc.from + arc.to), half = 0.5 * (arc.to - arc.from);
#pragma GCC unroll 1  // unrolled, the loop would not be vectorised
  for (std::size_t i = 0; i < kArcNodes; ++i) {
    double s, c;
    sincos_poly(middle + half * kArcNode[i], s, c);
    const double d = std::max(0.0, f.k0 + c * (f.k1 + f.k3 * c + f.k4 * s) + f.k2 * s);
    const double r = depth_power_slope<kCurveExponent>(d);
    t.term[0][i] = depth_power<kCurveExponent>(d);
    t.term[1][i] = r;
    t.term[2][i] = r * c;
    t.term[3][i] = r * s;
    t.term[4][i] = r * c * c;
    t.term[5][i] = r * c * s;
    t.term[6][i] = d;
  }
  const double w = 2.0 * half / kArcNodes;
  out = {w * t.sum(0), w * t.sum(1), w * t.sum(2), w * t.sum(3), w * t.sum(4), w * t.sum(5), t.largest(6)};
}

Pressure pressure_of(const Circle& circle, const ArcSums& t) {
  const Vec3 &e1 = circle.e1, &e2 = circle.e2, &c = circle.centre;
  const double r = circle.radius;
  const Vec3 swing = r * (t.rate_c * e1 + t.rate_s * e2), along = r * r * (t.rate_cc * e1 + t.rate_cs * e2),
             across = r * r * (t.rate_cs * e1 + (t.rate - t.rate_cc) * e2), x = t.rate * c + swing;
  return {r * t.rate, r * x,
          r * (c * x.transpose() + swing * c.transpose() + e1 * along.transpose() + e2 * across.transpose())};
}

}  // namespace packbed
