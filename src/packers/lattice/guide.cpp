// digicgp: a pellet is guided by the cells that stopped it in the last step.
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

/// A unit force along the line from a taken cell to the centre of mass; `arm` is the way back.
void add_force(const Vec3& arm, Push& push) {
  push.force -= arm / std::max(arm.norm(), 1e-3);
}

/// Moves by one cell, or adds what is in the way.
bool move_or_push(State& state, std::size_t i, int axis, int sign, Push& push, Tally& tally) {
  if (try_move(state, i, axis, sign, tally)) return true;
  const Vec3 face = Vec3::Unit(axis) * -sign;  // towards the pellet
  state.lattice.for_each_hit_on_move(state.stamp[i], state.cell[i], axis, sign, [&](int x, int y, int z) {
    const Vec3 arm = Vec3(x, y, z) - state.phase[i];
    add_force(arm, push);
    push.torque += arm.cross(face);
  });
  return false;
}

/// Rotates about the torque, or adds what is in the way.
void rotate_or_push(const Model& model, State& state, std::size_t i, const Guide& guide, double u,
                    StampMaker& maker, Push& push, Tally& tally) {
  const double reach = model.kind(state.kind[i]).shape->bounding_radius * state.scale[i] / model.frame.pitch;
  const double most = std::min(model.rules.max_angle, model.rules.max_sweep / reach);
  try_rotation(
      model, state, i, guide.torque, u * most, maker, tally, [&](const Stamp& tried, const Vec3& phase) {
        state.lattice.for_each_hit(tried, state.cell[i],
                                   [&](int x, int y, int z) { add_force(Vec3(x, y, z) - phase, push); });
      });
}

}  // namespace

void move_digicgp(const Model& model, State& state, std::size_t i, StampMaker& maker, Tally& tally) {
  const Guide guide = state.guide[i];
  Push push;
  if (!guide.free) {
    Random random = numbers_of(model, state, i);
    if (random.uniform() < model.rules.rebound * guide.chance.z()) try_move(state, i, 2, 1, tally);
    for (int axis = 0; axis < 2; ++axis) {
      const double p = guide.chance[axis];
      if (random.uniform() < std::abs(p)) move_or_push(state, i, axis, p > 0 ? 1 : -1, push, tally);
    }
    const double u = random.uniform();
    if (guide.torque.squaredNorm() > 0 && random.uniform() < model.rules.rotation_share)
      rotate_or_push(model, state, i, guide, u, maker, push, tally);
  }
  move_or_push(state, i, 2, -1, push, tally);
  const double largest = push.force.cwiseAbs().maxCoeff(), turn = push.torque.norm();
  state.guide[i] = {};
  if (!(largest > 0)) return;
  state.guide[i].free = 0;
  state.guide[i].chance = push.force / largest;
  if (turn > 1e-9) state.guide[i].torque = push.torque / turn;
}

}  // namespace packbed::lattice
