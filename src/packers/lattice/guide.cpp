// digicgp: a pellet is guided by the collisions of the last step, its own and those of others with it
// (collisions.hpp).
#include <algorithm>
#include <cmath>

#include "packers/lattice/step.hpp"

namespace packbed::lattice {
namespace {

/// Cells that a pellet may move along an axis before its neighbours are looked for again.
constexpr int kRoam = 3;

/// The turn of one pellet: tries on its surroundings; on the lattice it moves once, at the end.
class Turn {
 public:
  Turn(const Model& model, State& state, std::size_t i, Workspace& work, Turns& turns)
      : model_(model), state_(state), i_(i), work_(work), turns_(turns), home_(state.cell[i]) {
    work.surroundings.look(state.lattice, state.stamp[i], home_, reach());
  }
  ~Turn() {
    const Cell by = moved({0, 0, 0});
    if (!lifted_ && by == Cell{0, 0, 0}) return;
    land(by);
    state_.box[i_] = box_of(state_.stamp[i_], state_.cell[i_]);
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  /// Moves by one cell, or tells what is in the way.
  void move(int axis, int sign) {
    ++turns_.tally.moves;
    Cell by{0, 0, 0};
    by[static_cast<std::size_t>(axis)] = sign;
    const Stamp& stamp = state_.stamp[i_];
    if (work_.surroundings.list_hits(stamp, moved(by), work_.hits)) {
      collide({stamp, state_.phase[i_], by, work_.hits.rows(), Vec3::Unit(axis) * -sign});
      return;
    }
    state_.cell[i_][static_cast<std::size_t>(axis)] += sign;
    ++turns_.tally.moved;
  }

  /// Rotates about the torque when there is room.
  void rotate(const Vec3& torque, double u) {
    const double most = std::min(model_.rules.max_angle, model_.rules.max_sweep / radius());
    const Quat turn = turn_about(torque, u * most);
    const Cell here = moved({0, 0, 0});
    ++turns_.tally.rotations;
    const auto taken = [&](const Cell& c) {
      return work_.surroundings.taken({here[0] + c[0], here[1] + c[1], here[2] + c[2]});
    };
    if (!model_.rules.turn_cells &&
        model_.probes[state_.kind[i_]].meet(state_.scale[i_], turned_rotation(state_, i_, turn),
                                            StampMaker::first_phase(), state_.probe[i_], taken))
      return;
    Turned turned = turned_by(model_, state_, i_, turn, work_.maker);
    if (work_.surroundings.hits(turned.stamp, here)) return;
    state_.lattice.flip(state_.stamp[i_], home_);
    lifted_ = true;
    take(state_, i_, std::move(turned), turns_.tally);
  }

 private:
  double radius() const {  // [cells]
    return model_.kind(state_.kind[i_]).shape->bounding_radius * state_.scale[i_] / model_.frame.pitch;
  }
  /// Cells of the copy: the pellet at any rotation, its phase, its empty border, a move along each axis; a
  /// pellet whose cells are turned may have grown.
  int reach() const {
    int cells = static_cast<int>(std::ceil(radius())) + 3;
    const Stamp& s = state_.stamp[i_];
    for (std::size_t d = 0; d < 3; ++d) cells = std::max({cells, 1 - s.low[d], s.low[d] + s.size[d] + 1});
    return cells;
  }
  Cell moved(const Cell& by) const {
    Cell out;
    for (std::size_t d = 0; d < 3; ++d) out[d] = state_.cell[i_][d] - home_[d] + by[d];
    return out;
  }
  /// Puts the pellet down where its moves, at most one along each axis, have brought it.
  void land(const Cell& by) {
    const Stamp& stamp = state_.stamp[i_];
    if (!lifted_ && std::abs(by[0]) + std::abs(by[1]) + std::abs(by[2]) == 1) {
      const std::size_t axis = by[0] ? 0 : by[1] ? 1 : 2;
      Cell at = home_;
      state_.lattice.move(stamp, at, static_cast<int>(axis), by[axis]);
      return;
    }
    if (!lifted_) state_.lattice.flip(stamp, home_);
    state_.lattice.flip(stamp, state_.cell[i_]);
  }
  void collide(const Tried& tried) { work_.collisions.push(state_, i_, tried, turns_.pushes); }

  const Model& model_;
  State& state_;
  std::size_t i_;
  Workspace& work_;
  Turns& turns_;
  Cell home_;
  bool lifted_ = false;
};

}  // namespace

void move_digicgp(const Model& model, State& state, std::size_t i, Workspace& work, Turns& turns) {
  const Guide guide = state.guide[i];
  Random random = numbers_of(model, state, i);
  Turn turn(model, state, i, work, turns);
  if (guide.free) {  // as in digipac
    const std::uint32_t way = random.bits();
    turn.move(static_cast<int>(way & 1U), way & 2U ? 1 : -1);
    turn.move(2, -1);
    return;
  }
  const bool up = random.uniform() < model.rules.rebound * guide.chance.z();
  for (int axis = 0; axis < 2; ++axis) {
    const double p = guide.chance[axis];
    if (random.uniform() < std::abs(p)) turn.move(axis, p > 0 ? 1 : -1);
  }
  const bool ball = model.kind(state.kind[i]).shape->kind == ShapeClass::sphere;  // looks the same turned
  if (guide.torque.squaredNorm() > 0 && !ball) turn.rotate(guide.torque, random.uniform());
  turn.move(2, up ? 1 : -1);
}

void find_near(const Model& model, State& state) {
  state.box.resize(state.size());
  state.probe.resize(state.size());
  for (std::size_t i = 0; i < state.size(); ++i) state.box[i] = box_of(state.stamp[i], state.cell[i]);
  const auto roamed = [&](std::size_t i) {
    for (std::size_t d = 0; d < 3; ++d)
      if (std::abs(state.cell[i][d] - state.near_since[i][d]) > kRoam) return true;
    return false;
  };
  bool due = state.near_since.size() != state.size();
  for (std::size_t i = 0; i < state.size() && !due; ++i) due = roamed(i);
  if (!due) return;
  std::vector<std::uint32_t> all(state.size());
  std::vector<Vec3> place(state.size());
  std::vector<double> reach(state.size());
  const std::vector<std::uint8_t> still(state.size(), 0);
  for (std::size_t i = 0; i < state.size(); ++i) {
    all[i] = static_cast<std::uint32_t>(i);
    place[i] = Vec3(state.cell[i][0], state.cell[i][1], state.cell[i][2]);
    // what either may roam by along each axis to the end of a step, a phase's change in it, and rounding
    reach[i] = model.kind(state.kind[i]).shape->bounding_radius * state.scale[i] / model.frame.pitch +
               std::sqrt(3.0) * (kRoam + 3);
  }
  std::vector<BodyPair> pairs;
  NeighbourSearch().find(all, place, reach, still, pairs);
  state.near_from.assign(state.size() + 1, 0);
  for (const BodyPair& p : pairs) ++state.near_from[p.a + 1], ++state.near_from[p.b + 1];
  for (std::size_t i = 0; i < state.size(); ++i) state.near_from[i + 1] += state.near_from[i];
  state.near.resize(2 * pairs.size());
  std::vector<std::uint32_t> next(state.near_from.begin(), state.near_from.end() - 1);
  for (const BodyPair& p : pairs) {
    state.near[next[p.a]++] = p.b;
    state.near[next[p.b]++] = p.a;
  }
  state.near_since = state.cell;
}

void take_guides(State& state, const std::vector<Turns>& turns) {
  std::vector<Push> sum(state.size());
  for (const Turns& t : turns)
    for (const Push& p : t.pushes) {
      sum[p.pellet].force += p.force;
      sum[p.pellet].torque += p.torque;
    }
  for (std::size_t i = 0; i < state.size(); ++i) {
    const double largest = sum[i].force.cwiseAbs().maxCoeff(), turn = sum[i].torque.norm();
    Guide& guide = state.guide[i] = {};
    if (!(largest > 1e-9)) continue;
    guide.free = 0;
    guide.chance = sum[i].force / largest;
    if (turn > 1e-9) guide.torque = sum[i].torque / turn;
  }
}

}  // namespace packbed::lattice
