// digicgp: a pellet that cannot fall is guided by the cells that stop it.
//
//        o          each cell that the pellet would enter and finds taken counts with a force of 1: along the
//      /   \        line from it to the centre of mass for the net force, square to the face that it comes
//     o     |       through for the torque about the centre of mass
//   ##x     x##
#include <algorithm>
#include <cmath>

#include "packers/lattice/step.hpp"

namespace packbed::lattice {
namespace {

struct Push {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
};

/// Adds what stops a pellet from moving by one cell.
void add_push(const State& state, std::size_t i, int axis, int sign, Push& push) {
  const Vec3 face = Vec3::Unit(axis) * -sign;  // towards the pellet
  state.lattice.for_each_hit_on_move(state.stamp[i], state.cell[i], axis, sign, [&](int x, int y, int z) {
    const Vec3 arm = Vec3(x, y, z) - state.phase[i];  // from the centre of mass to the cell's centre
    push.force -= arm / std::max(arm.norm(), 1e-3);
    push.torque += arm.cross(face);
  });
}

}  // namespace

void move_digicgp(const Model& model, State& state, std::size_t i, StampMaker& maker, Tally& tally) {
  Random random = numbers_of(model, state, i);
  const LatticeRules& rules = model.rules;
  if (random.uniform() < 0.5 * rules.rebound) {
    try_move(state, i, 2, 1, tally);
    return;
  }
  if (try_move(state, i, 2, -1, tally)) return;
  Push push;
  add_push(state, i, 2, -1, push);
  const Vec3 chance = push.force / std::max(push.force.cwiseAbs().maxCoeff(), 1e-12);
  for (int axis = 0; axis < 2; ++axis) {
    const double p = chance[axis];
    if (random.uniform() >= std::abs(p)) continue;
    const int sign = p > 0 ? 1 : -1;
    if (!try_move(state, i, axis, sign, tally)) add_push(state, i, axis, sign, push);
  }
  const double length = push.torque.norm(), u = random.uniform();
  if (!(length > 1e-9) || random.uniform() >= rules.rotation_share) return;
  const double reach = model.kind(state.kind[i]).shape->bounding_radius * state.scale[i] / model.frame.pitch;
  const double most = std::min(rules.max_angle, rules.max_sweep / reach);
  try_rotation(model, state, i, push.torque / length, u * most, maker, tally);
}

}  // namespace packbed::lattice
