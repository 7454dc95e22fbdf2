#include "bed/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace packbed {
namespace {

constexpr std::size_t kCells = 8192;  // of the grid that a law is summed on, evenly in ln d

double cube(double x) {
  return x * x * x;
}

/// Number and volume of pellets up to each size, both from 0 to 1; ascending.
struct Cumulative {
  std::vector<double> size, number, volume;
  double mean_cube = 0;  // [m3]
};

/// dF / d ln d but for a constant.
double density(const SizeDistribution& s, double d) {
  const double power = std::pow(d / s.modulus, s.exponent);
  switch (s.law) {
    case SizeLaw::rosin_rammler:
      return power * std::exp(-power);
    case SizeLaw::gates_gaudin_schuhmann:
      return power;
    case SizeLaw::log_normal:
      return std::exp(-0.5 * std::pow(std::log(d / s.modulus) / std::log(s.deviation), 2));
    case SizeLaw::one:
    case SizeLaw::table:
      break;
  }
  return 0;
}

/// Makes the sums of number and of d^3 cumulative shares.
void finish(Cumulative& c) {
  std::partial_sum(c.number.begin(), c.number.end(), c.number.begin());
  std::partial_sum(c.volume.begin(), c.volume.end(), c.volume.begin());
  const double number = c.number.back(), volume = c.volume.back();
  c.mean_cube = volume / number;
  for (double& x : c.number) x /= number;
  for (double& x : c.volume) x /= volume;
}

Cumulative of_table(const SizeDistribution& s) {
  std::vector<std::size_t> order(s.diameter.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return s.diameter[a] < s.diameter[b]; });
  Cumulative c;
  for (const std::size_t i : order) {
    const double d = s.diameter[i];
    if (d < s.smallest || d > s.largest) continue;
    const double number = s.by == SizeBasis::number ? s.amount[i] : s.amount[i] / cube(d);
    c.size.push_back(d);
    c.number.push_back(number);
    c.volume.push_back(number * cube(d));
  }
  finish(c);
  return c;
}

Cumulative of_law(const SizeDistribution& s) {
  constexpr double kNode = 0.2113248654051871;  // Gauss-Legendre, two points on [0, 1]: kNode and 1 - kNode
  Cumulative c;
  const double low = std::log(s.smallest), width = (std::log(s.largest) - low) / kCells;
  for (std::size_t i = 0; i <= kCells; ++i) {
    double number = 0, volume = 0;
    for (const double node : {kNode, 1 - kNode}) {
      if (i == 0) break;  // nothing lies under the smallest
      const double d = std::exp(low + width * (static_cast<double>(i - 1) + node)), f = density(s, d);
      number += s.by == SizeBasis::number ? f : f / cube(d);
      volume += s.by == SizeBasis::number ? f * cube(d) : f;
    }
    c.size.push_back(std::exp(low + width * static_cast<double>(i)));
    c.number.push_back(number);
    c.volume.push_back(volume);
  }
  finish(c);
  return c;
}

Cumulative cumulative(const SizeDistribution& s) {
  return s.law == SizeLaw::table ? of_table(s) : of_law(s);
}

/// y at x, between the points of a law.
double interpolated(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto above = std::upper_bound(xs.begin(), xs.end(), x);
  if (above == xs.begin()) return ys.front();
  if (above == xs.end()) return ys.back();
  const std::size_t i = static_cast<std::size_t>(above - xs.begin());
  return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
}

std::vector<SizeClass> classes_of_table(const Cumulative& c, std::uint32_t count, double reference) {
  std::vector<SizeClass> classes;
  std::vector<double> shares;
  for (std::size_t i = c.size.size(); i-- > 0;) {
    shares.push_back(c.number[i] - (i > 0 ? c.number[i - 1] : 0.0));
    classes.push_back({c.size[i] / reference, 0, shares.back()});
  }
  const std::vector<std::uint32_t> counts = largest_remainder(shares, count);
  for (std::size_t i = 0; i < counts.size(); ++i) classes[i].count = counts[i];
  return classes;
}

std::vector<SizeClass> classes_of_law(const Cumulative& c, std::uint32_t count, double reference) {
  std::vector<SizeClass> classes;
  classes.reserve(count);
  double above = 1;
  for (std::uint32_t k = count; k-- > 0;) {
    const double below = k > 0 ? interpolated(c.number, c.volume, static_cast<double>(k) / count) : 0;
    classes.push_back({std::cbrt(c.mean_cube * count * (above - below)) / reference, 1, 1.0 / count});
    above = below;
  }
  return classes;
}

}  // namespace

std::vector<std::uint32_t> largest_remainder(std::span<const double> shares, std::uint32_t total) {
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  std::vector<std::uint32_t> counts;
  std::vector<double> remainder;
  std::uint32_t given = 0;
  for (const double share : shares) {
    const double worth = share / sum * total, whole = std::floor(worth * (1 + 1e-12));
    counts.push_back(static_cast<std::uint32_t>(whole));
    remainder.push_back(worth - whole);
    given += counts.back();
  }
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return remainder[a] > remainder[b]; });
  for (std::size_t i = 0; given < total; ++i, ++given) ++counts[order[i % order.size()]];
  return counts;
}

std::vector<SizeClass> size_classes(const SizeDistribution& sizes, std::uint32_t count, double reference) {
  if (sizes.law == SizeLaw::one) return {{1, count, 1}};
  const Cumulative c = cumulative(sizes);
  return sizes.law == SizeLaw::table ? classes_of_table(c, count, reference)
                                     : classes_of_law(c, count, reference);
}

double smallest_scale(std::span<const SizeClass> classes) {
  double scale = classes.empty() ? 1 : std::numeric_limits<double>::infinity();
  for (const SizeClass& c : classes)
    if (c.count > 0) scale = std::min(scale, c.scale);
  return scale;
}

double largest_scale(std::span<const SizeClass> classes) {
  double scale = classes.empty() ? 1 : 0;
  for (const SizeClass& c : classes)
    if (c.count > 0) scale = std::max(scale, c.scale);
  return scale;
}

double mean_cubed_scale(std::span<const SizeClass> classes) {
  double sum = 0, count = 0;
  for (const SizeClass& c : classes) {
    sum += c.count * cube(c.scale);
    count += c.count;
  }
  return count > 0 ? sum / count : 1;
}

double mean_cube(const SizeDistribution& sizes) {
  return cumulative(sizes).mean_cube;
}

double share_under(const SizeDistribution& sizes, double d, SizeBasis by) {
  const Cumulative c = cumulative(sizes);
  const std::vector<double>& share = by == SizeBasis::number ? c.number : c.volume;
  if (sizes.law != SizeLaw::table) return interpolated(c.size, share, d);
  const auto above = std::upper_bound(c.size.begin(), c.size.end(), d * (1 + 1e-12));
  return above == c.size.begin() ? 0.0 : share[static_cast<std::size_t>(above - c.size.begin()) - 1];
}

}  // namespace packbed
