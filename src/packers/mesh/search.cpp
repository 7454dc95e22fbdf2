// Phases feed and find_pairs: who is in the scene, and who may touch whom before the next search.
#include <algorithm>
#include <cmath>

#include "packers/mesh/flight.hpp"
#include "packers/mesh/kernels.hpp"
#include "packers/mesh/step.hpp"

namespace packbed::mesh {
namespace {

// A body may go this many steps at its present speed before the list is made anew: rarer searches, longer
// lists.
constexpr double kHorizonSteps = 60;
// What moves faster is not part of the bed's surface [m/s].
constexpr double kSurfaceSpeed = 0.2;
constexpr std::uint32_t kNone = 0xffffffff;

void enter(const Model& model, State& state, const Pellet& pellet) {
  const Kind& kind = model.kinds[pellet.shape];
  Bodies& b = state.bodies;
  const double s = pellet.scale, cube = s * s * s;
  add_body(b, {pellet.shape, cube * kind.mass, cube * s * s * kind.inertia, s * kind.bounding_radius,
               pellet.pose, pellet.velocity, pellet.spin, pellet.fixed, model.may_fly && !pellet.fixed, s});
  const std::size_t i = b.size() - 1;
  state.flight_from.push_back(state.time);
  state.flight_end.push_back(state.time);
  state.listed_at.push_back(pellet.pose.position);
  state.margin.push_back(0);
  state.doze.emplace_back();
  state.doze.back().anchor = pellet.pose.position;
  state.doze.back().anchor_rotation = b.rotation[i];
  state.rest.anchor.push_back(pellet.pose.position);
  if (b.motion[i] == Motion::airborne) begin_flight(model, state, i);
  if (!pellet.fixed)
    state.ledger.input +=
        kinetic_translation(b, i) + kinetic_rotation(b, i) - b.mass[i] * model.gravity.dot(b.position[i]);
}

bool still(Motion m) {
  return m == Motion::asleep || m == Motion::fixed;
}

bool quiet(const Bodies& b, const BodyPair& pair) {
  return still(b.motion[pair.a]) && (is_container(pair.b) || still(b.motion[pair.b]));
}

void add_container_pairs(const Model& model, const State& state, std::vector<BodyPair>& pairs) {
  const Bodies& b = state.bodies;
  const ContainerKind kind = model.container.kind;
  if (kind == ContainerKind::none) return;
  for (std::uint32_t i : state.awake) {
    const double reach = b.bounding_radius[i] + state.margin[i];
    const Vec3& x = b.position[i];
    if (kind == ContainerKind::mesh) pairs.push_back({i, kSolid});
    if (kind != ContainerKind::mesh && x.z() < reach) pairs.push_back({i, kFloor});
    if (kind == ContainerKind::box)
      for (std::uint32_t side = 0; side < 4; ++side)
        if (side_of(model.container, side).distance(x) < reach) pairs.push_back({i, kSide + side});
    if (kind == ContainerKind::tube && std::hypot(x.x(), x.y()) + reach > model.container.radius)
      pairs.push_back({i, kWall});
  }
}

/// Old pairs that touch while both stand still keep their forces; they are not searched for again.
void keep_quiet_pairs(const State& state, std::vector<BodyPair>& pairs) {
  for (std::size_t p = 0; p < state.pairs.pair.size(); ++p)
    if (state.pairs.load[p].delta > 0 && quiet(state.bodies, state.pairs.pair[p]))
      pairs.push_back(state.pairs.pair[p]);
}

/// Puts values into the order of the new list. old: of each pair its place in the list before, or kNone.
template <class T>
void carry(std::vector<T>& values, const std::vector<std::uint32_t>& old, const T& blank) {
  std::vector<T> now(old.size(), blank);
  for (std::size_t p = 0; p < old.size(); ++p)
    if (old[p] != kNone) now[p] = std::move(values[old[p]]);
  values.swap(now);
}

/// Slots for what will be known of pairs that are new; those of pairs that are gone are vacant again.
void hand_out_slots(Pairs& pairs, const std::vector<std::uint32_t>& old) {
  std::vector<std::uint32_t> left = pairs.slot;
  for (const std::uint32_t o : old)
    if (o != kNone) left[o] = kNone;
  for (const std::uint32_t slot : left)
    if (slot != kNone) pairs.vacant.push_back(slot);
  carry(pairs.slot, old, kNone);
  for (std::uint32_t& slot : pairs.slot) {
    if (slot != kNone) continue;
    if (pairs.vacant.empty()) {
      pairs.vacant.push_back(static_cast<std::uint32_t>(pairs.features.size()));
      pairs.features.emplace_back();
    }
    slot = pairs.vacant.back();
    pairs.vacant.pop_back();
    pairs.features[slot].known = false;
  }
}

/// Carries what is known of pairs over to the new list; both lists ascend.
void carry_over(Pairs& pairs, std::vector<BodyPair>& fresh, bool fields) {
  std::vector<std::uint32_t> old(fresh.size(), kNone);
  std::uint32_t at = 0;
  for (std::size_t p = 0; p < fresh.size(); ++p) {
    while (at < pairs.pair.size() && pairs.pair[at] < fresh[p]) ++at;
    if (at < pairs.pair.size() && pairs.pair[at] == fresh[p]) old[p] = at;
  }
  pairs.pair.swap(fresh);
  carry(pairs.look_at, old, 0.0);
  carry(pairs.load, old, Load{});
  carry(pairs.record, old, PairRecord{});
  if (!fields) {
    hand_out_slots(pairs, old);
    return;
  }
  carry(pairs.patches, old, PatchRecords{});
  carry(pairs.near, old, NearPoints{});
}

void index_pairs(const Bodies& bodies, Pairs& pairs) {
  pairs.first.assign(bodies.size() + 1, 0);
  pairs.active.clear();
  pairs.shore_stale = 1;
  for (std::uint32_t p = 0; p < pairs.pair.size(); ++p) {
    const auto [a, b] = pairs.pair[p];
    ++pairs.first[a + 1];
    if (!is_container(b)) ++pairs.first[b + 1];
    if (!quiet(bodies, pairs.pair[p])) pairs.active.push_back(p);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) pairs.first[i + 1] += pairs.first[i];
  pairs.entry.resize(pairs.first.back());
  std::vector<std::uint32_t> next(pairs.first.begin(), pairs.first.end() - 1);
  for (std::uint32_t p = 0; p < pairs.pair.size(); ++p) {
    const auto [a, b] = pairs.pair[p];
    pairs.entry[next[a]++] = 2 * p;
    if (!is_container(b)) pairs.entry[next[b]++] = 2 * p + 1;
  }
}

/// How far the fastest of the awake goes in a step, beside the thinnest wall. Asked at each search: a body
/// that has become much faster since has left its margin and asked for one.
void note_strides(const Model& model, State& state) {
  if (!(model.thinnest_wall > 0)) return;
  const Bodies& b = state.bodies;
  for (const std::uint32_t i : state.awake) {
    const double speed = b.velocity[i].norm() + b.spin[i].norm() * b.bounding_radius[i];
    state.ledger.stride = std::max(state.ledger.stride, speed * model.step / model.thinnest_wall);
  }
}

}  // namespace

void settle_accounts(State& state) {
  for (PairRecord& r : state.pairs.record) {
    state.ledger.damped += r.damped;
    state.ledger.rubbed += r.rubbed;
    state.ledger.peak = std::max(state.ledger.peak, r.peak);
    state.ledger.touches += r.touches;
    state.ledger.deep_touches += r.deep_touches;
    r.damped = r.rubbed = r.peak = 0;
    r.touches = r.deep_touches = 0;
  }
}

void feed(const Model& model, State& state, Feeder& feeder) {
  if (state.time + 0.5 * model.step < feeder.next_time()) return;
  catch_up(model, state);
  const Bodies& b = state.bodies;
  std::vector<Pellet> present(b.size());
  double surface = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    present[i].id = static_cast<std::uint32_t>(i);
    present[i].shape = b.kind[i];
    present[i].pose = {b.position[i], b.rotation[i]};
    if (b.motion[i] != Motion::airborne && b.velocity[i].norm() < kSurfaceSpeed)
      surface = std::max(surface, b.position[i].z() + b.bounding_radius[i]);
  }
  const std::vector<Pellet> entering = feeder.enter(state.time, present, surface);
  for (const Pellet& pellet : entering) enter(model, state, pellet);
  if (!entering.empty()) state.search_due = 1;
  if (feeder.waiting()) state.waited = 1;
}

void find_pairs(const Model& model, State& state) {
  if (!state.search_due && state.time + model.step <= state.next_landing) return;
  state.search_due = 0;
  ++state.ledger.searches;
  settle_accounts(state);
  catch_up(model, state);
  Bodies& b = state.bodies;
  const double horizon = kHorizonSteps * model.step;
  for (std::size_t i = 0; i < b.size(); ++i) {
    state.margin[i] = model.skin + (b.motion[i] == Motion::awake ? b.velocity[i].norm() * horizon : 0.0);
    state.listed_at[i] = b.position[i];
  }
  land(model, state, horizon);
  std::vector<std::uint32_t> present;
  std::vector<std::uint8_t> stands(b.size());
  std::vector<double> reach(b.size());
  state.awake.clear();
  for (std::uint32_t i = 0; i < b.size(); ++i) {
    stands[i] = still(b.motion[i]);
    reach[i] = b.bounding_radius[i] + state.margin[i];
    if (b.motion[i] != Motion::airborne) present.push_back(i);
    if (b.motion[i] == Motion::awake) state.awake.push_back(i);
  }
  note_strides(model, state);
  std::vector<BodyPair> fresh;
  NeighbourSearch search;
  search.find(present, b.position, reach, stands, fresh);
  add_container_pairs(model, state, fresh);
  keep_quiet_pairs(state, fresh);
  std::sort(fresh.begin(), fresh.end());
  carry_over(state.pairs, fresh, uses_fields(model));
  index_pairs(b, state.pairs);
}

}  // namespace packbed::mesh
