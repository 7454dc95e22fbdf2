#include "contact/damping.hpp"

#include <cassert>
#include <cmath>

namespace packbed {
namespace {

/// w0 t_c. The force vanishes when tan(s w0 t) = -2 zeta s / (1 - 2 zeta^2), s = sqrt(|1 - zeta^2|);
/// hyperbolic for zeta > 1, and 2 at zeta = 1.
double duration(double zeta) {
  const double s2 = 1 - zeta * zeta, s = std::sqrt(std::abs(s2));
  if (s < 1e-6) return 2;  // the next term is of the order of s^2
  if (s2 > 0) return std::atan2(2 * zeta * s, zeta * zeta - s2) / s;
  return 2 * std::log(zeta + s) / s;
}

}  // namespace

double restitution_from_damping(double zeta) {
  assert(zeta >= 0);
  return std::exp(-zeta * duration(zeta));
}

double damping_from_restitution(double restitution) {
  assert(restitution > 0 && restitution <= 1);
  if (restitution >= 1) return 0;
  double low = 0, high = 1;
  while (restitution_from_damping(high) > restitution) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (restitution_from_damping(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double contact_time_factor(double zeta) {
  return duration(zeta);
}

double peak_overlap_factor(double zeta) {
  const double s2 = 1 - zeta * zeta, s = std::sqrt(std::abs(s2));
  if (s < 1e-6) return std::exp(-1.0);
  if (s2 > 0) return std::exp(-zeta / s * std::atan2(s, zeta));
  return std::exp(-zeta / s * std::log(zeta + s));
}

}  // namespace packbed
