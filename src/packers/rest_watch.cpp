#include "packers/rest_watch.hpp"

#include <algorithm>
#include <cmath>

namespace packbed {
namespace {

// Windows that a bed in which all were woken is given to come to rest.
constexpr std::uint8_t kWatchedWindows = 5;

}  // namespace

void RestLook::add(std::size_t i, double speed2, double unbalanced, const Vec3& position, double size) {
  pellets_.push_back({(position - watch_.anchor[i]).norm() / size, speed2, unbalanced});
  watch_.anchor[i] = position;
}

void RestLook::finish(const Stepping& limits, double time, bool flying) {
  watch_.rollers = static_cast<std::int32_t>(std::count_if(
      pellets_.begin(), pellets_.end(), [&](const Pellet& p) { return p.drift > limits.rest_drift; }));
  // one that rolls loses little, and may go on and on
  const auto left_out = static_cast<std::size_t>(limits.rest_rollers * static_cast<double>(pellets_.size()));
  std::nth_element(pellets_.begin(), pellets_.begin() + static_cast<std::ptrdiff_t>(left_out), pellets_.end(),
                   [](const Pellet& a, const Pellet& b) { return a.drift > b.drift; });
  double speed2 = 0, unbalanced = 0, drift = 0;
  for (std::size_t i = left_out; i < pellets_.size(); ++i) {
    speed2 += pellets_[i].speed2;
    unbalanced += pellets_[i].unbalanced;
    drift = std::max(drift, pellets_[i].drift);
  }
  const double n = std::max<double>(1.0, static_cast<double>(pellets_.size() - left_out));
  watch_.speed = std::sqrt(speed2 / n);
  watch_.force = unbalanced / n;
  watch_.drift = drift;
  watch_.at_rest = !flying && watch_.speed <= limits.rest_speed && watch_.force <= limits.rest_force &&
                   watch_.drift <= limits.rest_drift;
  watch_.since = time;
}

bool ask_once_more(RestWatch& watch) {
  std::uint8_t& windows = watch.last_watch;
  if (windows > 0) {
    if (!watch.at_rest)
      windows = windows < kWatchedWindows ? static_cast<std::uint8_t>(windows + 1) : std::uint8_t{0};
    return false;
  }
  windows = watch.at_rest;
  watch.at_rest = 0;
  return windows > 0;
}

}  // namespace packbed
