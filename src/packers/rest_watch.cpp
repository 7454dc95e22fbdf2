#include "packers/rest_watch.hpp"

#include <algorithm>
#include <cmath>

namespace packbed {
namespace {

// Of so many pellets one may drift on in a bed at rest: one that rolls loses little.
constexpr std::size_t kRollers = 1000;

}  // namespace

void RestLook::add(std::size_t i, double speed2, double unbalanced, const Vec3& position, double size) {
  speed2_ += speed2;
  unbalanced_ += unbalanced;
  drifts_.push_back((position - watch_.anchor[i]).norm() / size);
  watch_.anchor[i] = position;
}

void RestLook::finish(const Stepping& limits, double time, bool flying) {
  const std::size_t moving = drifts_.size();
  const double n = std::max<double>(1.0, static_cast<double>(moving));
  watch_.speed = std::sqrt(speed2_ / n);
  watch_.force = unbalanced_ / n;
  const auto last = static_cast<std::ptrdiff_t>(moving - moving / kRollers);
  if (last > 0) std::nth_element(drifts_.begin(), drifts_.begin() + (last - 1), drifts_.end());
  watch_.drift = last > 0 ? drifts_[static_cast<std::size_t>(last - 1)] : 0.0;
  watch_.rollers = static_cast<std::int32_t>(
      std::count_if(drifts_.begin(), drifts_.end(), [&](double d) { return d > limits.rest_drift; }));
  watch_.at_rest = !flying && watch_.speed <= limits.rest_speed && watch_.force <= limits.rest_force &&
                   watch_.drift <= limits.rest_drift;
  watch_.since = time;
}

}  // namespace packbed
