// Shaking of a bed at rest (packers/shaking).
#include "packers/mesh/account.hpp"
#include "packers/mesh/step.hpp"

namespace packbed::mesh {

bool shake(const Scene& scene, State& state) {
  if (scene.shaking.kind == ShakingKind::none) return false;
  Bodies& b = state.bodies;
  std::vector<Pellet> pellets;
  for (std::size_t i = 0; i < b.size(); ++i) pellets.push_back(pellet_of(state, i));
  const auto push = next_shake(scene, state.shake, state.time, pellets);
  if (!push) return false;
  wake_all(state);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.motion[i] == Motion::fixed) continue;
    state.ledger.input += b.mass[i] * push->dot(b.velocity[i] + 0.5 * *push);
    b.velocity[i] += *push;
  }
  state.search_due = 1;  // margins are for slower bodies
  state.rest.last_watch = 0;
  state.rest.at_rest = 0;
  state.rest.since = state.time;
  return true;
}

}  // namespace packbed::mesh
