// Phases move, rest and shake of digidem.
#include <algorithm>
#include <cmath>

#include "math/threads.hpp"
#include "packers/lattice/dem.hpp"

namespace packbed::lattice {
namespace {

constexpr double kRim = 0.5;     // cells that a rim may turn by before the pellet is drawn anew
constexpr double kCarry = 0.75;  // cells that a pellet may be off its stamp's cell before it is laid anew

/// Keeps stamp, offset and turn of a pellet up to date.
void follow(const DemModel& model, DemState& state, std::size_t i, StampMaker& maker) {
  const double pitch = model.base.frame.pitch;
  const Bodies& b = state.bodies;
  const Cell& c = state.cell[i];
  state.offset[i] = b.position[i] - model.base.frame.centre(c[0], c[1], c[2]) - pitch * state.phase[i];
  const Quat since = b.rotation[i] * state.drawn[i].conjugate();
  state.turn[i] = 2 * (since.w() < 0 ? -1.0 : 1.0) * since.vec();
  const bool ball = model.base.kind(b.kind[i]).shape->kind == ShapeClass::sphere;
  if (!ball && state.turn[i].norm() * b.bounding_radius[i] > kRim * pitch)
    redraw(model, state, i, maker);
  else if (state.offset[i].cwiseAbs().maxCoeff() > kCarry * pitch)
    relay(model, state, i);
  if (ball) state.turn[i].setZero();
}

}  // namespace

void dem_move(const DemModel& model, DemState& state) {
  Bodies& b = state.bodies;
  const Scene& scene = *model.base.scene;
  const Vec3 gravity = model.gravity + shaking_acceleration(scene.shaking, -model.gravity.normalized(),
                                                            state.shake, state.time);
  parallel_for(state.awake.size(), 64, [&](std::size_t begin, std::size_t end) {
    StampMaker maker(model.base.frame.pitch, model.base.largest);
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = state.awake[k];
      if (b.motion[i] != Motion::awake) continue;  // has just fallen asleep
      kick(b, i, gravity, model.step);  // two halves in one: velocities are those between two steps
      drift(b, i, model.step);
      follow(model, state, i, maker);
    }
  });
  ++state.steps;
  state.time += model.step;
}

double kinetic_speed(const DemState& state) {
  double sum = 0;
  for (const Vec3& v : state.bodies.velocity) sum += v.squaredNorm();
  return std::sqrt(sum / std::max<double>(1.0, static_cast<double>(state.size())));
}

void dem_rest(const DemModel& model, DemState& state, const Feeder& feeder) {
  const Stepping& s = model.base.scene->stepping;
  RestWatch& rest = state.rest;
  if (!feeder.done() || vibrates(state.shake, state.time)) {
    rest.anchor.clear();  // no window
    return;
  }
  if (!rest.anchor.empty() && state.time - rest.since < s.rest_window) return;
  const std::vector<Vec3>& x = state.bodies.position;
  if (!rest.anchor.empty()) {
    double drift = 0;
    for (std::size_t i = 0; i < x.size(); ++i) drift = std::max(drift, (x[i] - rest.anchor[i]).norm());
    rest.drift = drift / (2 * model.base.largest);
    rest.speed = kinetic_speed(state);
    rest.at_rest = rest.drift <= s.rest_drift && rest.speed <= s.rest_speed;
    if (rest.at_rest && s.sleep && !rest.last_watch) {  // once more, with all of them awake
      wake_all(state);
      rest.at_rest = 0;
      rest.last_watch = 1;
    }
  }
  rest.anchor = x;
  rest.since = state.time;
}

void dem_shake(const DemModel& model, DemState& state) {
  if (!state.rest.at_rest) return;
  const auto push = next_shake(*model.base.scene, state.shake, state.time, pellets_of(state));
  if (!push) return;
  wake_all(state);
  state.rest = {};
  for (std::size_t i = 0; i < state.size(); ++i)
    if (state.bodies.motion[i] != Motion::fixed) state.bodies.velocity[i] += *push;
}

}  // namespace packbed::lattice
