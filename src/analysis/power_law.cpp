#include "analysis/power_law.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <set>

#include "math/error.hpp"

namespace packbed {
namespace {

constexpr double kLeastN = 0.01, kMostN = 20;
constexpr int kScan = 100;

using Vector = Eigen::VectorXd;

struct Problem {
  Vector log_x, y;

  Vector power(double n) const { return (n * log_x).array().exp(); }
  Vector residual(const Eigen::Vector3d& p) const { return (y - p[1] * power(p[2])).array() - p[0]; }
  Eigen::MatrixX3d jacobian(const Eigen::Vector3d& p) const {  // of the law
    Eigen::MatrixX3d j(y.size(), 3);
    j.col(0).setOnes();
    j.col(1) = power(p[2]);
    j.col(2) = p[1] * j.col(1).cwiseProduct(log_x);
    return j;
  }
  /// a and b that fit best with this n.
  Eigen::Vector3d best_line(double n) const {
    Eigen::MatrixX2d m(y.size(), 2);
    m.col(0).setOnes();
    m.col(1) = power(n);
    const Eigen::Vector2d ab = m.colPivHouseholderQr().solve(y);
    return {ab[0], ab[1], n};
  }
};

Eigen::Vector3d best_of_scan(const Problem& problem) {
  Eigen::Vector3d best = problem.best_line(kLeastN);
  for (int i = 1; i <= kScan; ++i) {
    const Eigen::Vector3d p = problem.best_line(kLeastN * std::pow(kMostN / kLeastN, 1.0 * i / kScan));
    if (problem.residual(p).squaredNorm() < problem.residual(best).squaredNorm()) best = p;
  }
  return best;
}

Eigen::Vector3d levenberg_marquardt(const Problem& problem, Eigen::Vector3d p) {
  double damping = 1e-3, sum = problem.residual(p).squaredNorm();
  for (int step = 0; step < 200; ++step) {
    const Eigen::MatrixX3d j = problem.jacobian(p);
    Eigen::Matrix3d normal = j.transpose() * j;
    normal.diagonal() *= 1 + damping;
    const Eigen::Vector3d move = normal.ldlt().solve(j.transpose() * problem.residual(p));
    const double after = problem.residual(p + move).squaredNorm();
    if (!(after < sum)) {
      if (damping > 1e10) break;
      damping *= 10;
      continue;
    }
    const bool done = move.norm() < 1e-13 * p.norm();
    p += move;
    sum = after;
    damping = std::max(1e-12, damping / 10);
    if (done) break;
  }
  return p;
}

void check(std::span<const double> x, std::span<const double> y, std::size_t fitted) {
  const std::set<double> different(x.begin(), x.end());
  if (x.size() != y.size() || x.size() <= fitted || different.size() < fitted)
    throw InputError("law", fmt::format("{} beds of {} different size ratios", x.size(), different.size()),
                     fmt::format("{} beds and {} size ratios at least", fitted + 1, fitted),
                     "pack more beds");
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(x[i] > 0) || !std::isfinite(x[i]) || !std::isfinite(y[i]))
      throw InputError("law", fmt::format("a bed of size ratio {:g} and porosity {:g}", x[i], y[i]),
                       "a ratio greater than 0 and a number");
}

Problem problem_of(std::span<const double> x, std::span<const double> y, std::size_t fitted) {
  check(x, y, fitted);
  const auto n = static_cast<Eigen::Index>(x.size());
  Problem problem{Vector(n), Vector(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    problem.log_x[i] = std::log(x[static_cast<std::size_t>(i)]);
    problem.y[i] = y[static_cast<std::size_t>(i)];
  }
  return problem;
}

/// With the intervals of the first `fitted` parameters.
PowerLaw law_of(const Problem& problem, const Eigen::Vector3d& p, Eigen::Index fitted, double confidence) {
  PowerLaw law;
  law.points = static_cast<int>(problem.y.size());
  const int freedom = law.points - static_cast<int>(fitted);
  law.confidence = confidence;
  law.sd = std::sqrt(problem.residual(p).squaredNorm() / freedom);
  const Eigen::MatrixXd j = problem.jacobian(p).leftCols(fitted);
  const Eigen::MatrixXd covariance = (j.transpose() * j).inverse() * law.sd * law.sd;
  const double t = student_t(confidence, freedom);
  for (Eigen::Index k = 0; k < 3; ++k) {
    law.value[static_cast<std::size_t>(k)] = p[k];
    law.half_width[static_cast<std::size_t>(k)] = k < fitted ? t * std::sqrt(covariance(k, k)) : 0;
  }
  return law;
}

/// P(|T| <= t).
double within(double t, int degrees) {
  const double angle = std::atan(t / std::sqrt(degrees)), s = std::sin(angle), c = std::cos(angle);
  double term = degrees % 2 ? c : 1, sum = degrees == 1 ? 0 : term;
  for (int k = degrees % 2 ? 3 : 2; k < degrees; k += 2) {
    term *= c * c * (k - 1) / k;
    sum += term;
  }
  return degrees % 2 ? 2 / std::numbers::pi * (angle + s * sum) : s * sum;
}

}  // namespace

double PowerLaw::at(double x) const {
  return value[0] + value[1] * std::pow(x, value[2]);
}

double student_t(double probability, int degrees) {
  double low = 0, high = 1;
  while (within(high, degrees) < probability) high *= 2;
  for (int i = 0; i < 100; ++i)
    (within(0.5 * (low + high), degrees) < probability ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y, double confidence) {
  const Problem problem = problem_of(x, y, 3);
  const Eigen::Vector3d p = levenberg_marquardt(problem, best_of_scan(problem));
  if (!(p[2] > kLeastN && p[2] < kMostN))
    throw InputError("law", fmt::format("points that are fitted best by an exponent of {:.3g}", p[2]),
                     fmt::format("one between {} and {}", kLeastN, kMostN),
                     "the points do not bend like the law");
  return law_of(problem, p, 3, confidence);
}

PowerLaw fit_power_law_of(double n, std::span<const double> x, std::span<const double> y, double confidence) {
  const Problem problem = problem_of(x, y, 2);
  return law_of(problem, problem.best_line(n), 2, confidence);
}

}  // namespace packbed
