// Phase rest: three questions, asked together over one window: how fast, how far from balance, how far
// drifted.
#include <algorithm>
#include <cmath>

#include "packers/mesh/step.hpp"

namespace packbed::mesh {
namespace {

// Windows that a bed in which all are awake is given to come to rest.
constexpr std::uint8_t kWatchedWindows = 5;
// Of so many pellets one may drift on in a bed at rest: a cylinder that rolls loses nothing.
constexpr std::size_t kRollers = 1000;

}  // namespace

void rest(const Model& model, State& state, const Feeder& feeder) {
  if (!feeder.done() || state.time - state.rest_since < model.stepping.rest_window) return;
  const Bodies& b = state.bodies;
  double speed2 = 0, unbalanced = 0;
  std::vector<double> drifts;
  std::size_t moving = 0, flying = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.motion[i] == Motion::fixed) continue;
    ++moving;
    flying += b.motion[i] == Motion::airborne;
    speed2 += 2.0 * (kinetic_translation(b, i) + kinetic_rotation(b, i)) / b.mass[i];
    const Vec3 weight = b.mass[i] * model.gravity;
    // sleepers have found their balance when they fell asleep
    if (b.motion[i] == Motion::awake)
      unbalanced += (b.force[i] + weight).norm() / std::max(1e-300, weight.norm());
    drifts.push_back((b.position[i] - state.rest_anchor[i]).norm() / model.size);
    state.rest_anchor[i] = b.position[i];
  }
  const double n = std::max<double>(1.0, static_cast<double>(moving));
  state.rest_speed = std::sqrt(speed2 / n);
  state.rest_force = unbalanced / n;
  // one in a thousand may still roll
  const auto last = static_cast<std::ptrdiff_t>(moving - moving / kRollers);
  if (last > 0) std::nth_element(drifts.begin(), drifts.begin() + (last - 1), drifts.end());
  state.rest_drift = last > 0 ? drifts[static_cast<std::size_t>(last - 1)] : 0.0;
  state.rollers = static_cast<std::int32_t>(
      std::count_if(drifts.begin(), drifts.end(), [&](double d) { return d > model.stepping.rest_drift; }));
  state.at_rest = flying == 0 && state.rest_speed <= model.stepping.rest_speed &&
                  state.rest_force <= model.stepping.rest_force &&
                  state.rest_drift <= model.stepping.rest_drift;
  state.rest_since = state.time;
  if (!model.stepping.sleep) return;
  // rest found with sleepers is not yet rest: all wake, and the same questions are asked again over the next
  // windows; if one pellet rolls on through all of them, the others may sleep again
  if (state.last_watch == 0 && state.at_rest) {
    state.last_watch = 1;
    state.at_rest = 0;
    wake_all(state);
  } else if (state.last_watch > 0 && !state.at_rest) {
    state.last_watch = state.last_watch < kWatchedWindows ? static_cast<std::uint8_t>(state.last_watch + 1)
                                                          : std::uint8_t{0};
  }
}

}  // namespace packbed::mesh
