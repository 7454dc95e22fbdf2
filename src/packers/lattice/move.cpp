// Phase move: every pellet in turn. Pellets of one slab of height touch no cell of the slab after the next,
// so that every other slab may be worked on at the same time; within a slab the pellets take turns in the
// order in which they were fed. Neither depends on the number of threads.
#include "lattice/digital_rotation.hpp"
#include "math/threads.hpp"
#include "math/trig.hpp"
#include "packers/lattice/step.hpp"

namespace packbed::lattice {
namespace {

/// Pellets by slab. The slabs' boundaries are elsewhere in every step, so that they leave no mark.
std::vector<std::vector<std::uint32_t>> slabs_of(const Model& model, State& state) {
  Random random(model.scene->seed, Stream::lattice_move, 0xffffffff, static_cast<std::uint32_t>(state.steps));
  const int shift = static_cast<int>(random.uniform() * model.slab);
  std::vector<std::vector<std::uint32_t>> slabs(
      static_cast<std::size_t>((model.frame.size[2] + shift) / model.slab + 1));
  state.slab.resize(state.size());
  for (std::size_t i = 0; i < state.size(); ++i) {
    state.slab[i] = (state.cell[i][2] + shift) / model.slab;
    if (!state.fixed[i])
      slabs[static_cast<std::size_t>(state.slab[i])].push_back(static_cast<std::uint32_t>(i));
  }
  return slabs;
}

}  // namespace

void move(const Model& model, State& state) {
  const auto slabs = slabs_of(model, state);
  const bool guided = model.method == Method::digicgp;
  if (guided) find_near(model, state);
  std::vector<Turns> turns(slabs.size());
  for (std::size_t parity = 0; parity < 2; ++parity)
    parallel_for((slabs.size() + 1 - parity) / 2, 1, [&](std::size_t begin, std::size_t end) {
      StampMaker maker(model.frame.pitch, model.largest);
      for (std::size_t k = begin; k < end; ++k)
        for (const std::uint32_t i : slabs[2 * k + parity])
          (guided ? move_digicgp : move_digipac)(model, state, i, maker, turns[2 * k + parity]);
    });
  for (const Turns& t : turns) state.tally.add(t.tally);
  if (guided) take_guides(state, turns);
  ++state.steps;
}

Random numbers_of(const Model& model, const State& state, std::size_t i) {
  return {model.scene->seed, Stream::lattice_move, state.id[i], static_cast<std::uint32_t>(state.steps)};
}

bool try_move(State& state, std::size_t i, int axis, int sign, Tally& tally) {
  ++tally.moves;
  if (state.lattice.hits_on_move(state.stamp[i], state.cell[i], axis, sign)) return false;
  state.lattice.move(state.stamp[i], state.cell[i], axis, sign);
  ++tally.moved;
  return true;
}

bool try_rotation(const Model& model, State& state, std::size_t i, const Vec3& axis, double angle,
                  StampMaker& maker, Tally& tally,
                  const std::function<void(const Stamp&, const Vec3&)>& blocked) {
  const Shape& shape = *model.kind(state.kind[i]).shape;
  if (shape.kind == ShapeClass::sphere) return false;  // looks the same however it is turned
  ++tally.rotations;
  double sine, cosine;
  sincos_poly(0.5 * angle, sine, cosine);
  const Quat turn(cosine, sine * axis.x(), sine * axis.y(), sine * axis.z());
  const Quat rotation = (turn * state.rotation[i]).normalized();
  Vec3 phase = state.phase[i];
  Stamp stamp = model.rules.turn_cells ? turn_cells(state.stamp[i], phase, turn)
                                       : maker.make_true(shape, state.scale[i], rotation, phase);
  state.lattice.flip(state.stamp[i], state.cell[i]);
  const bool free = !state.lattice.hits(stamp, state.cell[i]);
  if (free) {
    state.stamp[i] = std::move(stamp);
    state.rotation[i] = rotation;
    state.phase[i] = phase;
    ++tally.rotated;
  } else if (blocked) {
    blocked(stamp, phase);
  }
  state.lattice.flip(state.stamp[i], state.cell[i]);
  return free;
}

void move_digipac(const Model& model, State& state, std::size_t i, StampMaker& maker, Turns& turns) {
  Random random = numbers_of(model, state, i);
  const LatticeRules& rules = model.rules;
  const std::uint32_t way = random.bits();
  try_move(state, i, 2, random.uniform() < 0.5 * rules.rebound ? 1 : -1, turns.tally);
  try_move(state, i, static_cast<int>(way & 1U), way & 2U ? 1 : -1, turns.tally);
  if (random.uniform() >= rules.rotation_share) return;
  const double angle = random.uniform() * rules.max_angle;
  try_rotation(model, state, i, random.on_sphere(), angle, maker, turns.tally);
}

}  // namespace packbed::lattice
