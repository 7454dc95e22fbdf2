// digicgp: a pellet is guided by the collisions of the last step, its own and those of others with it.
//
//        o          each cell that a pellet would enter and finds taken is a pair of colliding voxels. Both
//        of
//      /   \        their pellets feel a force of 1: along the line from the cell to their own centre of mass
//     o     |       for the net force, square to the face that it comes through for the torque
//   ##x     x##
#include <algorithm>
#include <cmath>

#include "packers/lattice/step.hpp"

namespace packbed::lattice {
namespace {

/// Cells that a pellet may move along an axis before its neighbours are looked for again.
constexpr int kRoam = 3;

/// Corners of the box of a pellet's cells on the lattice, its empty border included.
struct Box {
  Cell low, high;
};
Box box_of(const Stamp& stamp, const Cell& at) {
  Box box{at, at};
  for (std::size_t d = 0; d < 3; ++d) {
    box.low[d] += stamp.low[d];
    box.high[d] = box.low[d] + stamp.size[d];
  }
  return box;
}

bool meet(const Box& a, const Box& b) {
  for (std::size_t d = 0; d < 3; ++d)
    if (a.low[d] >= b.high[d] || b.low[d] >= a.high[d]) return false;
  return true;
}

/// The collisions of one pellet in one try.
class Collision {
 public:
  /// `tried`: the box that is tried.
  Collision(const State& state, std::size_t i, const Box& tried, std::vector<Push>& pushes)
      : state_(state), i_(i), pushes_(pushes) {
    own_.pellet = static_cast<std::uint32_t>(i);
    for (std::uint32_t k = state.near_from[i]; k < state.near_from[i + 1]; ++k) {
      const std::uint32_t j = state.near[k];
      if (std::abs(state.slab[j] - state.slab[i]) > 1) continue;  // out of reach, and perhaps on the move
      if (meet(tried, box_of(state.stamp[j], state.cell[j]))) others_.push_back({j});
    }
  }
  ~Collision() {
    pushes_.push_back(own_);
    for (const Push& p : others_)
      if (p.force != Vec3::Zero()) pushes_.push_back(p);
  }
  Collision(const Collision&) = delete;
  Collision& operator=(const Collision&) = delete;

  /// A taken cell (x, y, z), counted from the pellet's own, whose centre of mass is at `phase`; `face`:
  /// square to the face that it comes through, towards the pellet; zero: not known.
  void add(const Cell& at, const Vec3& phase, const Vec3& face) {
    push(own_, Vec3(at[0], at[1], at[2]) - phase, face);
    if (last_ < others_.size() && push_other(others_[last_], at, face)) return;
    for (last_ = 0; last_ < others_.size(); ++last_)
      if (push_other(others_[last_], at, face)) return;  // else it is the wall's
  }

 private:
  static void push(Push& p, const Vec3& arm, const Vec3& face) {
    p.force -= arm / std::max(arm.norm(), 1e-3);
    p.torque += arm.cross(face);
  }
  /// When the cell is this pellet's.
  bool push_other(Push& p, Cell at, const Vec3& face) const {
    const Cell &from = state_.cell[i_], &to = state_.cell[p.pellet];
    for (std::size_t d = 0; d < 3; ++d) at[d] += from[d] - to[d];
    if (!has_cell(state_.stamp[p.pellet], at)) return false;
    push(p, Vec3(at[0], at[1], at[2]) - state_.phase[p.pellet], -face);
    return true;
  }

  const State& state_;
  std::size_t i_, last_ = 0;
  Push own_;
  std::vector<Push> others_;
  std::vector<Push>& pushes_;
};

/// Moves by one cell, or tells what is in the way.
void move_or_collide(State& state, std::size_t i, int axis, int sign, Turns& turns) {
  if (try_move(state, i, axis, sign, turns.tally)) return;
  const Vec3 face = Vec3::Unit(axis) * -sign;
  Collision collision(state, i, box_of(state.stamp[i], state.cell[i]), turns.pushes);  // border included
  state.lattice.for_each_hit_on_move(state.stamp[i], state.cell[i], axis, sign, [&](int x, int y, int z) {
    collision.add({x, y, z}, state.phase[i], face);
  });
}

/// Rotates about the torque, or tells what is in the way.
void rotate_or_collide(const Model& model, State& state, std::size_t i, const Guide& guide, double u,
                       StampMaker& maker, Turns& turns) {
  const double reach = model.kind(state.kind[i]).shape->bounding_radius * state.scale[i] / model.frame.pitch;
  const double most = std::min(model.rules.max_angle, model.rules.max_sweep / reach);
  try_rotation(model, state, i, guide.torque, u * most, maker, turns.tally,
               [&](const Stamp& tried, const Vec3& phase) {
                 Collision collision(state, i, box_of(tried, state.cell[i]), turns.pushes);
                 state.lattice.for_each_hit(tried, state.cell[i], [&](int x, int y, int z) {
                   collision.add({x, y, z}, phase, Vec3::Zero());
                 });
               });
}

}  // namespace

void move_digicgp(const Model& model, State& state, std::size_t i, StampMaker& maker, Turns& turns) {
  const Guide guide = state.guide[i];
  Random random = numbers_of(model, state, i);
  if (guide.free) {  // as in digipac
    const std::uint32_t way = random.bits();
    move_or_collide(state, i, static_cast<int>(way & 1U), way & 2U ? 1 : -1, turns);
    move_or_collide(state, i, 2, -1, turns);
    return;
  }
  const bool up = random.uniform() < model.rules.rebound * guide.chance.z();
  for (int axis = 0; axis < 2; ++axis) {
    const double p = guide.chance[axis];
    if (random.uniform() < std::abs(p)) move_or_collide(state, i, axis, p > 0 ? 1 : -1, turns);
  }
  if (guide.torque.squaredNorm() > 0)
    rotate_or_collide(model, state, i, guide, random.uniform(), maker, turns);
  move_or_collide(state, i, 2, up ? 1 : -1, turns);
}

void find_near(const Model& model, State& state) {
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
