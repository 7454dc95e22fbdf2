#include "analysis/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace packbed {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Voxels first: every input has them.
const std::vector<double>& curve(const Profile& p) {
  return p.density.empty() ? p.exact : p.density;
}

double bulk_of(const AnalysisResult& r) {
  return std::isfinite(r.bulk.packing_density) ? r.bulk.packing_density : r.bulk.exact;
}

Profile within(const Profile& p, double from, double to) {
  Profile out;
  const std::vector<double>& values = curve(p);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (p.x_dp[i] < from || p.x_dp[i] > to) continue;
    out.x_dp.push_back(p.x_dp[i]);
    out.density.push_back(values[i]);
  }
  return out;
}

}  // namespace

double rms_distance(const Profile& a, const Profile& b) {
  const std::vector<double>&ya = curve(a), &yb = curve(b);
  double sum = 0;
  int n = 0;
  std::size_t k = 0;
  for (std::size_t i = 0; i < ya.size(); ++i) {
    const double x = a.x_dp[i];
    while (k + 1 < yb.size() && b.x_dp[k + 1] < x) ++k;
    if (k + 1 >= yb.size() || x < b.x_dp[k]) continue;
    const double t = (x - b.x_dp[k]) / (b.x_dp[k + 1] - b.x_dp[k]);
    const double gap = (1 - t) * yb[k] + t * yb[k + 1] - ya[i];
    if (!std::isfinite(gap)) continue;
    sum += gap * gap;
    ++n;
  }
  return n > 0 ? std::sqrt(sum / n) : kNaN;
}

KolmogorovSmirnov ks_distance(std::vector<double> a, std::vector<double> b) {
  const auto clean = [](std::vector<double>& v) {
    std::erase_if(v, [](double x) { return !std::isfinite(x); });
    std::sort(v.begin(), v.end());
  };
  clean(a);
  clean(b);
  if (a.empty() || b.empty()) return {kNaN, kNaN};
  const double n = static_cast<double>(a.size()), m = static_cast<double>(b.size());
  std::size_t i = 0, j = 0;
  double most = 0;
  while (i < a.size() && j < b.size()) {
    const double x = std::min(a[i], b[j]);
    while (i < a.size() && a[i] <= x) ++i;
    while (j < b.size() && b[j] <= x) ++j;
    most = std::max(most, std::abs(static_cast<double>(i) / n - static_cast<double>(j) / m));
  }
  constexpr double kSmirnov = 1.358;
  return {most, kSmirnov * std::sqrt((n + m) / (n * m))};
}

Distances distances(const AnalysisResult& first, const AnalysisResult& other) {
  Distances d;
  d.bulk = bulk_of(other) - bulk_of(first);
  const auto end = [](const AnalysisResult& r) {
    return r.bulk.diameter_m > 0 ? r.bulk.z_range_m[1] / r.bulk.diameter_m : 0.0;
  };
  const double to = std::min(end(first), end(other));
  d.axial = rms_distance(within(first.axial, 0, to), within(other.axial, 0, to + 1));
  d.radial = rms_distance(first.radial, other.radial);
  const auto angles = [](const AnalysisResult& r) {
    return r.orientation ? r.orientation->angle_deg : std::vector<double>{};
  };
  d.orientation = ks_distance(angles(first), angles(other));
  return d;
}

}  // namespace packbed
