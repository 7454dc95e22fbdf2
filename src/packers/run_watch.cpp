#include "packers/run_watch.hpp"

#include <fmt/format.h>

namespace packbed {

std::string settling_text(const Stepping& limits, const RestWatch& rest, bool watching) {
  std::string text = watching ? "watching" : "settling";
  const auto name = [&](const char* what, double value, double most) {
    if (value > most) text += fmt::format(", {} {:.2g} (limit {:.2g})", what, value, most);
  };
  name("speed m/s", rest.speed, limits.rest_speed);
  name("force", rest.force, limits.rest_force);
  name("drift", rest.drift, limits.rest_drift);
  return text;
}

}  // namespace packbed
