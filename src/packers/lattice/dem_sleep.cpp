// Phase sleep of digidem, and the sorting of touches by who is awake.
#include <algorithm>
#include <cmath>

#include "math/threads.hpp"
#include "packers/lattice/dem.hpp"

namespace packbed::lattice {
namespace {

double size_of(const DemModel& model, const DemState& state, std::size_t i) {
  const Bodies& b = state.bodies;
  return b.scale[i] * model.base.kind(b.kind[i]).shape->equivalent_diameter();
}

void wake(DemState& state, std::size_t i) {
  wake_from_shadow(state.doze[i], state.bodies, i);
  ++state.wakes;
  state.stale = 1;
}

/// What of each pellet's touches is no longer carried [N].
std::vector<double> lost_support(const DemState& state) {
  std::vector<double> lost(state.size());
  for (const Touch& t : state.touches) {
    const double less = std::max(0.0, t.held - t.force.norm());
    lost[t.a] += less;
    if (!is_wall(t.b)) lost[t.b] += less;
  }
  return lost;
}

void let_sleep(const DemModel& model, DemState& state) {
  Bodies& b = state.bodies;
  std::vector<std::uint8_t> touches(state.size());
  for (const Touch& t : state.touches)
    if (t.depth > 0) {
      touches[t.a] = 1;
      if (!is_wall(t.b)) touches[t.b] = 1;
    }
  std::vector<std::uint8_t> falls(state.size());
  for (const std::uint32_t i : state.awake) {
    if (b.motion[i] != Motion::awake) continue;
    const double size = size_of(model, state, i);
    falls[i] = touches[i] &&
               has_stayed(state.doze[i], b, i, size, model.base.scene->stepping.sleep_displacement * size);
    if (!falls[i]) {
      begin_watch(state.doze[i], b, i);
      continue;
    }
    fall_asleep(state.doze[i], b, i);
    ++state.sleeps;
    state.stale = 1;
  }
  for (Touch& t : state.touches)
    if (falls[t.a] || (!is_wall(t.b) && falls[t.b])) t.held = t.force.norm();
}

}  // namespace

void add_forces(const Touch& t, const std::vector<Vec3>& position, std::vector<Vec3>& force,
                std::vector<Vec3>& torque) {
  force[t.a] += t.force;
  torque[t.a] += (t.point - position[t.a]).cross(t.force) + t.couple;
  if (is_wall(t.b)) return;
  force[t.b] -= t.force;
  torque[t.b] -= (t.point - position[t.b]).cross(t.force) + t.couple;
}

void find_active(DemState& state) {
  if (!state.stale) return;
  state.stale = 0;
  const Bodies& b = state.bodies;
  state.active.clear();
  state.awake.clear();
  state.shore.clear();
  state.resting_force.assign(state.size(), Vec3::Zero());
  state.resting_torque.assign(state.size(), Vec3::Zero());
  for (std::size_t i = 0; i < state.size(); ++i)
    if (b.motion[i] == Motion::awake) state.awake.push_back(static_cast<std::uint32_t>(i));
  for (std::size_t k = 0; k < state.touches.size(); ++k) {
    const Touch& t = state.touches[k];
    const Motion a = b.motion[t.a], other = is_wall(t.b) ? Motion::fixed : b.motion[t.b];
    if (a == Motion::awake || other == Motion::awake) {
      state.active.push_back(static_cast<std::uint32_t>(k));
      if (a == Motion::asleep) state.shore.push_back(t.a);
      if (other == Motion::asleep) state.shore.push_back(t.b);
    } else if (t.depth > 0) {
      add_forces(t, b.position, state.resting_force, state.resting_torque);
    }
  }
  std::sort(state.shore.begin(), state.shore.end());
  state.shore.erase(std::unique(state.shore.begin(), state.shore.end()), state.shore.end());
}

void wake_all(DemState& state) {
  for (std::size_t i = 0; i < state.size(); ++i)
    if (state.bodies.motion[i] == Motion::asleep) wake(state, i);
}

void dem_sleep(const DemModel& model, DemState& state) {
  const Scene& scene = *model.base.scene;
  if (!scene.stepping.sleep || state.rest.last_watch || vibrates(state.shake, state.time)) return;
  const bool watch_ends = (state.steps + 1) % model.watch == 0;
  std::vector<double> lost;
  if (watch_ends) lost = lost_support(state);
  std::vector<std::uint8_t> wakes(state.shore.size());
  const double gravity = model.gravity.norm();
  parallel_for(state.shore.size(), 128, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = state.shore[k];
      const double size = size_of(model, state, i);
      wakes[k] = step_shadow(state.doze[i], state.bodies, i, size, model.pellet.stiffness, model.step) >
                     scene.stepping.sleep_displacement * size ||
                 (watch_ends && lost[i] > kLostSupport * state.bodies.mass[i] * gravity);
    }
  });
  for (std::size_t k = 0; k < state.shore.size(); ++k)
    if (wakes[k]) wake(state, state.shore[k]);
  if (watch_ends) let_sleep(model, state);
}

}  // namespace packbed::lattice
