// Phase rest: pellets on a lattice never stand still, so a bed is at rest when its mean height has stopped
// sinking.
#include "packers/lattice/step.hpp"

namespace packbed::lattice {

void rest(const Model& model, State& state, const Feeder& feeder) {
  if (!feeder.done() || !state.waiting.empty()) {
    state.window_since = -1;
    return;
  }
  const bool open = state.window_since >= 0;
  if (open && state.steps - state.window_since < model.rules.rest_window) return;
  double height = 0;
  for (std::size_t i = 0; i < state.size(); ++i) height += state.cell[i][2] + state.phase[i].z();
  height /= std::max<double>(1.0, static_cast<double>(state.size()));
  if (open) {
    state.sinking = state.mean_height - height;
    state.at_rest = state.sinking < model.rules.rest_sinking;
  }
  state.mean_height = height;
  state.window_since = state.steps;
}

}  // namespace packbed::lattice
