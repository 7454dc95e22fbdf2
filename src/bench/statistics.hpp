#pragma once
// The few statistics that benches tell.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace packbed::bench {

/// The value that `part` of all lie under; NaN of nothing.
inline double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = part * static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::lround(place));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Mean {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();  // standard error; NaN of a single value
};

inline Mean mean_of(const std::vector<double>& values) {
  Mean out;
  if (values.empty()) return out;
  const double n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  out.value = sum / n;
  for (const double v : values) squares += (v - out.value) * (v - out.value);
  if (n > 1) out.error = std::sqrt(squares / (n - 1) / n);
  return out;
}

inline double root_mean_square(const std::vector<double>& values) {
  double squares = 0;
  for (const double v : values) squares += v * v;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

}  // namespace packbed::bench
