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
      Workspace work(model);
      for (std::size_t k = begin; k < end; ++k)
        for (const std::uint32_t i : slabs[2 * k + parity])
          (guided ? move_digicgp : move_digipac)(model, state, i, work, turns[2 * k + parity]);
    });
  for (const Turns& t : turns) state.tally.add(t.tally);
  if (guided) take_guides(state, turns);
  ++state.steps;
}

Random numbers_of(const Model& model, const State& state, std::size_t i) {
  return {model.scene->seed, Stream::lattice_move, state.id[i], static_cast<std::uint32_t>(state.steps)};
}

Quat turn_about(const Vec3& axis, double angle) {
  double sine, cosine;
  sincos_poly(0.5 * angle, sine, cosine);
  return {cosine, sine * axis.x(), sine * axis.y(), sine * axis.z()};
}

Quat turned_rotation(const State& state, std::size_t i, const Quat& turn) {
  return (turn * state.rotation[i]).normalized();
}

Turned turned_by(const Model& model, const State& state, std::size_t i, const Quat& turn, StampMaker& maker) {
  Turned out{turned_rotation(state, i, turn), state.phase[i], {}};
  out.stamp = model.rules.turn_cells ? turn_cells(state.stamp[i], out.phase, turn)
                                     : maker.make_true(*model.kind(state.kind[i]).shape, state.scale[i],
                                                       out.rotation, out.phase);
  return out;
}

void take(State& state, std::size_t i, Turned&& turned, Tally& tally) {
  state.stamp[i] = std::move(turned.stamp);
  state.rotation[i] = turned.rotation;
  state.phase[i] = turned.phase;
  ++tally.rotated;
}

namespace {

/// Moves a pellet by one cell unless it would share a cell then.
void try_move(State& state, std::size_t i, int axis, int sign, Tally& tally) {
  ++tally.moves;
  if (state.lattice.hits_on_move(state.stamp[i], state.cell[i], axis, sign)) return;
  state.lattice.move(state.stamp[i], state.cell[i], axis, sign);
  ++tally.moved;
}

/// Rotates a pellet unless it would share a cell then.
void try_rotation(const Model& model, State& state, std::size_t i, const Quat& turn, StampMaker& maker,
                  Tally& tally) {
  if (model.kind(state.kind[i]).shape->kind == ShapeClass::sphere) return;  // looks the same turned
  ++tally.rotations;
  Turned turned = turned_by(model, state, i, turn, maker);
  state.lattice.flip(state.stamp[i], state.cell[i]);
  if (!state.lattice.hits(turned.stamp, state.cell[i])) take(state, i, std::move(turned), tally);
  state.lattice.flip(state.stamp[i], state.cell[i]);
}

}  // namespace

void move_digipac(const Model& model, State& state, std::size_t i, Workspace& work, Turns& turns) {
  Random random = numbers_of(model, state, i);
  const LatticeRules& rules = model.rules;
  const std::uint32_t way = random.bits();
  try_move(state, i, 2, random.uniform() < 0.5 * rules.rebound ? 1 : -1, turns.tally);
  try_move(state, i, static_cast<int>(way & 1U), way & 2U ? 1 : -1, turns.tally);
  if (random.uniform() >= rules.rotation_share) return;
  const double angle = random.uniform() * rules.max_angle;
  try_rotation(model, state, i, turn_about(random.on_sphere(), angle), work.maker, turns.tally);
}

}  // namespace packbed::lattice
