// Phase rest: the questions of packers/rest_watch, and once more with nobody asleep.
#include <algorithm>

#include "packers/mesh/step.hpp"

namespace packbed::mesh {
namespace {

// Windows that a bed in which all are awake is given to come to rest.
constexpr std::uint8_t kWatchedWindows = 5;

}  // namespace

void rest(const Model& model, State& state, const Feeder& feeder) {
  RestWatch& watch = state.rest;
  if (vibrates(state.shake, state.time)) watch.since = state.time;
  if (!feeder.done() || state.time - watch.since < model.stepping.rest_window) return;
  const Bodies& b = state.bodies;
  RestLook look(watch);
  bool flying = false;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.motion[i] == Motion::fixed) continue;
    flying |= b.motion[i] == Motion::airborne;
    const Vec3 weight = b.mass[i] * model.gravity;
    // sleepers have found their balance when they fell asleep
    const double unbalanced =
        b.motion[i] == Motion::awake ? (b.force[i] + weight).norm() / std::max(1e-300, weight.norm()) : 0.0;
    look.add(i, 2.0 * (kinetic_translation(b, i) + kinetic_rotation(b, i)) / b.mass[i], unbalanced,
             b.position[i], model.size);
  }
  look.finish(model.stepping, state.time, flying);
  if (!model.stepping.sleep) return;
  // rest found with sleepers is not yet rest: all wake, and the same questions are asked again over the next
  // windows; if one pellet rolls on through all of them, the others may sleep again
  if (state.last_watch == 0 && watch.at_rest) {
    state.last_watch = 1;
    watch.at_rest = 0;
    wake_all(state);
  } else if (state.last_watch > 0 && !watch.at_rest) {
    state.last_watch = state.last_watch < kWatchedWindows ? static_cast<std::uint8_t>(state.last_watch + 1)
                                                          : std::uint8_t{0};
  }
}

}  // namespace packbed::mesh
