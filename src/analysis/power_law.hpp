#pragma once
// The fractal law of the porosity of beds of many sizes: porosity = a + b (smallest / largest)^n.
#include <array>
#include <span>

namespace packbed {

/// a, b, n in this order.
struct PowerLaw {
  std::array<double, 3> value{0, 0, 0};
  std::array<double, 3> half_width{0, 0, 0};  // of the confidence intervals
  double confidence = 0.95;
  double sd = 0;  // standard deviation of the points about the law, on points - 3 degrees of freedom
  int points = 0;

  double at(double x) const;
};

/// Least squares over all three (Levenberg-Marquardt from the best of a scan over n, where a and b are
/// linear). Intervals: Student's t times the standard errors of the linearised problem (Bates & Watts,
/// Nonlinear Regression Analysis, 1988, section 2.3). x > 0. Throws InputError for fewer than four points or
/// three different x, and for points that no exponent between 0.01 and 20 fits best.
PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y, double confidence = 0.95);

/// The same with a given exponent: a and b alone, on points - 2 degrees of freedom; n has no
/// interval. Throws InputError for fewer than three points or two different x.
PowerLaw fit_power_law_of(double n, std::span<const double> x, std::span<const double> y,
                          double confidence = 0.95);

/// Student's t that |T| stays under with this probability (Abramowitz & Stegun, 1964, 26.7.3 and 26.7.4).
double student_t(double probability, int degrees);

}  // namespace packbed
