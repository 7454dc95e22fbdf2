// Phase rest: the questions of packers/rest_watch, and once more with nobody asleep.
#include <algorithm>

#include "packers/mesh/step.hpp"

namespace packbed::mesh {

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
  if (model.stepping.sleep && ask_once_more(watch)) wake_all(state);
}

}  // namespace packbed::mesh
