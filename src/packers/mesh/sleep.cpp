// Phase sleep: pellets that have settled stand still until something would move them (dynamics/doze.hpp). One
// that touches nothing stays awake, and at the end of each watch the contacts of a sleeper are asked what
// they still carry.
#include <algorithm>
#include <cmath>

#include "math/threads.hpp"
#include "packers/mesh/step.hpp"

namespace packbed::mesh {
namespace {

double size_of(const Model& model, const Bodies& b, std::size_t i) {
  return b.scale[i] * model.kinds[b.kind[i]].shape->equivalent_diameter();
}

bool has_settled(const Model& model, const State& state, std::size_t i) {
  const Bodies& b = state.bodies;
  const double size = size_of(model, b, i);
  if (!has_stayed(state.doze[i], b, i, size, model.stepping.sleep_displacement * size)) return false;
  const Pairs& pairs = state.pairs;
  for (std::uint32_t e = pairs.first[i]; e < pairs.first[i + 1]; ++e)
    if (pairs.load[pairs.entry[e] >> 1].delta > 0) return true;
  return false;
}

void wake(State& state, std::size_t i) {
  Bodies& b = state.bodies;
  wake_from_shadow(state.doze[i], b, i);
  state.ledger.removed -= kinetic_translation(b, i) + kinetic_rotation(b, i);
  ++state.ledger.wakes;
  state.search_due = 1;
}

void put_to_sleep(State& state, std::size_t i) {
  Bodies& b = state.bodies;
  state.ledger.removed += kinetic_translation(b, i) + kinetic_rotation(b, i);
  ++state.ledger.sleeps;
  fall_asleep(state.doze[i], b, i);
  Pairs& pairs = state.pairs;
  for (std::uint32_t e = pairs.first[i]; e < pairs.first[i + 1]; ++e) {
    const std::uint32_t p = pairs.entry[e] >> 1;
    pairs.record[p].held = pairs.load[p].force.norm();
  }
  state.search_due = 1;
}

/// True when the shadow has gone too far.
bool shadow_wakes(const Model& model, State& state, std::size_t i) {
  Bodies& b = state.bodies;
  gather(state, i, b.force[i], b.torque[i]);
  const double size = size_of(model, b, i);
  return step_shadow(state.doze[i], b, i, size, model.pellet_law.stiffness, model.step) >
         model.stepping.sleep_displacement * size;
}

/// The contacts that can change carry less than they did when the body fell asleep.
bool has_lost_support(const Model& model, const State& state, std::size_t i) {
  const Pairs& pairs = state.pairs;
  double lost = 0;
  for (std::uint32_t e = pairs.first[i]; e < pairs.first[i + 1]; ++e) {
    const std::uint32_t p = pairs.entry[e] >> 1;
    lost += std::max(0.0, pairs.record[p].held - pairs.load[p].force.norm());
  }
  return lost > kLostSupport * state.bodies.mass[i] * model.gravity.norm();
}

/// Sleepers that have a pair with something that moves, ascending.
std::vector<std::uint32_t> find_shore(const State& state) {
  std::vector<std::uint32_t> shore;
  const std::vector<Motion>& motion = state.bodies.motion;
  for (std::uint32_t p : state.pairs.active) {
    const auto [a, b] = state.pairs.pair[p];
    if (motion[a] == Motion::asleep) shore.push_back(a);
    if (!is_container(b) && motion[b] == Motion::asleep) shore.push_back(b);
  }
  std::sort(shore.begin(), shore.end());
  shore.erase(std::unique(shore.begin(), shore.end()), shore.end());
  return shore;
}

}  // namespace

void wake_all(State& state) {
  for (std::size_t i = 0; i < state.bodies.size(); ++i)
    if (state.bodies.motion[i] == Motion::asleep) wake(state, i);
}

void sleep(const Model& model, State& state) {
  if (!model.stepping.sleep || state.rest.last_watch || vibrates(state.shake, state.time)) return;
  Bodies& b = state.bodies;
  const double contact_time =
      kPi * std::sqrt(0.5 * model.kinds.front().mass * std::pow(model.kinds.front().smallest, 3) /
                      model.pellet_law.stiffness);
  const auto watch = std::max<std::int64_t>(1, std::llround(kWatchContacts * contact_time / model.step));
  const bool watch_ends = state.steps % watch == 0;
  if (state.pairs.shore_stale) state.pairs.shore = find_shore(state);
  state.pairs.shore_stale = 0;
  const std::vector<std::uint32_t>& shore = state.pairs.shore;
  std::vector<std::uint8_t> wakes(shore.size());
  parallel_for(shore.size(), 128, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k)
      wakes[k] =
          shadow_wakes(model, state, shore[k]) || (watch_ends && has_lost_support(model, state, shore[k]));
  });
  for (std::size_t k = 0; k < shore.size(); ++k)
    if (wakes[k]) wake(state, shore[k]);
  if (!watch_ends) return;
  for (std::uint32_t i : state.awake) {
    if (b.motion[i] != Motion::awake) continue;
    if (has_settled(model, state, i))
      put_to_sleep(state, i);
    else
      begin_watch(state.doze[i], b, i);
  }
}

}  // namespace packbed::mesh
