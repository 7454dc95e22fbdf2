// Phases feed and find_pairs: who is in the scene, in which order they stand in memory, and who may touch
// whom before the next search.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "dynamics/level_grid.hpp"
#include "math/threads.hpp"
#include "packers/spheres/step.hpp"

namespace packbed::spheres {
namespace {

// A sphere may go this many steps at its present speed before the lists are made anew: rarer searches, longer
// lists.
constexpr double kHorizonSteps = 60;
// Searches between two sorts of the memory.
constexpr std::int64_t kSortEvery = 32;
// What moves faster is not part of the bed's surface [m/s].
constexpr double kSurfaceSpeed = 0.2;

Vec3 vec(const Quad& q) {
  return {q.x, q.y, q.z};
}

void enter(const Model& model, State& state, const Pellet& pellet) {
  Spheres& s = state.spheres;
  const Kind& kind = model.kinds[pellet.shape];
  const double radius = pellet.scale * kind.radius;
  const double mass = kind.density * 4.0 / 3.0 * kPi * radius * radius * radius,
               inertia = 0.4 * mass * radius * radius;
  const auto quad = [](const Vec3& v, double w) { return Quad{v.x(), v.y(), v.z(), w}; };
  s.id.push_back(pellet.id);
  s.kind.push_back(pellet.shape);
  s.scale.push_back(pellet.scale);
  s.place.push_back(quad(pellet.pose.position, radius));
  s.velocity.push_back(quad(pellet.velocity, pellet.fixed ? 0.0 : 1.0 / mass));
  s.spin.push_back(quad(pellet.spin, pellet.fixed ? 0.0 : 1.0 / inertia));
  s.ahead.push_back(quad(pellet.velocity, 0));
  s.listed_at.push_back(quad(pellet.pose.position, 0));
  state.rest.anchor.push_back(pellet.pose.position);
  if (pellet.fixed) return;
  state.ledger.input += 0.5 * mass * pellet.velocity.squaredNorm() +
                        0.5 * inertia * pellet.spin.squaredNorm() -
                        mass * model.gravity.dot(pellet.pose.position);
}

/// Bits of a number below 2^21, two zeros between each.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

/// The order of the spheres along a Z-curve through cells as wide as the smallest sphere.
std::vector<std::uint32_t> curve_order(const Spheres& s) {
  Box3 box;
  double smallest = 1e300;
  for (const Quad& x : s.place) box.extend(vec(x)), smallest = std::min(smallest, 2.0 * x.w);
  const double width = std::max(smallest, box.sizes().maxCoeff() / 2e6);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> key(s.size());
  for (std::uint32_t i = 0; i < s.size(); ++i) {
    const Vec3 cell = (vec(s.place[i]) - box.min()) / width;
    const auto at = [&](int k) { return spread(static_cast<std::uint64_t>(cell[k])); };
    key[i] = {at(0) | at(1) << 1 | at(2) << 2, i};
  }
  std::sort(key.begin(), key.end());
  std::vector<std::uint32_t> order(s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = key[i].second;
  return order;
}

template <class T>
void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  std::vector<T> sorted(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = values[order[i]];
  values.swap(sorted);
}

/// Where sphere i stood when the last lists were made, and whether it was there at all.
using Before = std::vector<std::uint32_t>;

Before sort_memory(State& state) {
  Spheres& s = state.spheres;
  const std::size_t n = s.size();
  const std::size_t listed = state.slot_first.empty() ? 0 : state.slot_first.size() - 1;
  for (std::vector<Quad>* of : {&s.force, &s.torque}) {
    of->resize(listed);  // the slots go; nothing acts yet on who has entered
    of->resize(n);
  }
  if (state.searches % kSortEvery != 0) {
    Before same(n);
    std::iota(same.begin(), same.end(), 0U);
    return same;
  }
  Before order = curve_order(s);
  reorder(s.id, order), reorder(s.kind, order), reorder(s.scale, order);
  reorder(s.place, order), reorder(s.velocity, order), reorder(s.spin, order), reorder(s.ahead, order);
  reorder(s.force, order), reorder(s.torque, order), reorder(s.listed_at, order);
  if (!state.gear.spin_ahead.empty()) {
    for (std::vector<Quad>& of : state.gear.position) reorder(of, order);
    for (std::vector<Quad>& of : state.gear.spin) reorder(of, order);
    reorder(state.gear.spin_ahead, order);
  }
  return order;
}

/// The springs of the old list, by partner.
template <class Pair>
class Memory {
 public:
  explicit Memory(List<Pair>& list) : list_(std::move(list)) {}

  /// Index of the pair (a, b) as a found it, or nothing.
  const Pair* find(std::uint32_t a, std::uint32_t b, std::size_t& index) const {
    if (a + 1 >= list_.first.size()) return nullptr;
    for (index = list_.first[a]; index < list_.first[a + 1]; ++index)
      if (partner(list_.pair[index]) == b) return &list_.pair[index];
    return nullptr;
  }
  const List<Pair>& list() const { return list_; }

 private:
  static std::uint32_t partner(const SpherePair& p) { return p.b; }
  static std::uint32_t partner(const SphereWallPair& p) { return p.wall; }
  List<Pair> list_;
};

/// What pair number `old` of one list remembered, for pair `p` of another; sign -1 when a and b have changed
/// places.
template <class Pair>
void hand_over(const List<Pair>& from, std::size_t old, double sign, List<Pair>& to, std::size_t p) {
  const auto signed_ = [&](const Quad& q) { return Quad{sign * q.x, sign * q.y, sign * q.z, q.w}; };
  to.drag[p] = from.drag[old];
  if (!to.slip.empty()) to.slip[p] = signed_(from.slip[old]);
  if (!to.roll.empty()) to.roll[p] = signed_(from.roll[old]);
}

/// Joins what the chunks have found into one list.
template <class Pair>
void join(const std::vector<std::vector<Pair>>& found, std::vector<std::uint32_t>& counts, const Model& model,
          List<Pair>& list) {
  list.first.assign(counts.size() + 1, 0);
  for (std::size_t i = 0; i < counts.size(); ++i) list.first[i + 1] = list.first[i] + counts[i];
  list.pair.clear();
  list.pair.reserve(list.first.back());
  for (const std::vector<Pair>& part : found) list.pair.insert(list.pair.end(), part.begin(), part.end());
  list.slip.assign(model.turns ? list.pair.size() : 0, Quad{});
  list.roll.assign(model.rolls ? list.pair.size() : 0, Quad{});
  list.drag.assign(list.pair.size(), 0.0);
}

void list_pairs(const Model& model, State& state, const std::vector<Quad>& reach, const Before& before) {
  const Spheres& s = state.spheres;
  const Memory<SpherePair> memory(state.pairs);
  LevelGrid grid(reach);
  std::vector<std::vector<SpherePair>> found(chunks_of(s.size()));
  std::vector<std::uint32_t> counts(s.size());
  parallel_for(found.size(), 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t c = from; c < to; ++c)
      for (std::size_t i = c * kChunk; i < std::min(s.size(), (c + 1) * kChunk); ++i) {
        const auto a = static_cast<std::uint32_t>(i);
        const std::size_t had = found[c].size();
        grid.for_each_near(a, [&](std::uint32_t b) {
          if (s.velocity[a].w > 0 || s.velocity[b].w > 0) found[c].push_back({a, b, b});
        });
        counts[i] = static_cast<std::uint32_t>(found[c].size() - had);
      }
  });
  List<SpherePair>& list = state.pairs;
  join(found, counts, model, list);
  parallel_for(list.pair.size(), 4096, [&](std::size_t from, std::size_t to) {
    for (std::size_t p = from; p < to; ++p) {
      const std::uint32_t a = before[list.pair[p].a], b = before[list.pair[p].b];
      std::size_t old = 0;
      if (memory.find(a, b, old))
        hand_over(memory.list(), old, 1.0, list, p);
      else if (memory.find(b, a, old))
        hand_over(memory.list(), old, -1.0, list, p);
    }
  });
}

double distance_from(const SphereWall& wall, const Vec3& x) {
  const bool round = vec(wall).squaredNorm() < 0.5;
  return round ? wall.w - std::hypot(x.x(), x.y()) : vec(wall).dot(x) - wall.w;
}

void list_walls(const Model& model, State& state, const std::vector<Quad>& reach, const Before& before) {
  const Spheres& s = state.spheres;
  const Memory<SphereWallPair> memory(state.walls);
  std::vector<std::vector<SphereWallPair>> found(1);
  std::vector<std::uint32_t> counts(s.size());
  for (std::uint32_t i = 0; i < s.size(); ++i) {
    if (!(s.velocity[i].w > 0)) continue;
    const auto add = [&](std::uint32_t wall, double distance) {
      if (distance >= reach[i].w) return;
      found[0].push_back({i, wall});
      ++counts[i];
    };
    const Vec3 x = vec(reach[i]);
    for (std::uint32_t w = 0; w < model.walls.size(); ++w) add(w, distance_from(model.walls[w], x));
    if (model.solid) add(0, model.solid->distance(x));
  }
  List<SphereWallPair>& list = state.walls;
  join(found, counts, model, list);
  for (std::size_t p = 0; p < list.pair.size(); ++p) {
    std::size_t old = 0;
    if (memory.find(before[list.pair[p].a], list.pair[p].wall, old))
      hand_over(memory.list(), old, 1.0, list, p);
  }
}

/// A pair whose second sphere is another chunk's leaves its force in a slot.
void give_slots(State& state) {
  Spheres& s = state.spheres;
  const std::size_t n = s.size();
  state.slot_first.assign(n + 1, 0);
  std::size_t slots = n;
  for (SpherePair& p : state.pairs.pair) {
    if (p.a / kChunk == p.b / kChunk) continue;
    p.to = static_cast<std::uint32_t>(slots++);
    ++state.slot_first[p.b + 1];
  }
  for (std::size_t i = 0; i < n; ++i) state.slot_first[i + 1] += state.slot_first[i];
  state.slot.resize(slots - n);
  std::vector<std::uint32_t> next(state.slot_first.begin(), state.slot_first.end() - 1);
  for (const SpherePair& p : state.pairs.pair)
    if (p.to != p.b) state.slot[next[p.b]++] = p.to;
  s.force.resize(slots);
  s.torque.resize(slots);
}

}  // namespace

void settle_accounts(State& state) {
  auto& l = state.ledger;
  for (SphereTally& t : state.tally) {
    l.damped += total(t.damped);
    l.rubbed += total(t.rubbed);
    for (int k = 0; k < 4; ++k) l.peak = std::max(l.peak, t.deepest[k]);
    l.touches += total(t.touches);
    l.deep += total(t.deep);
    l.very_deep += total(t.very_deep);
    t = SphereTally{};
  }
}

void feed(const Model& model, State& state, Feeder& feeder) {
  if (state.time + 0.5 * model.step < feeder.next_time()) return;
  const Spheres& s = state.spheres;
  std::vector<Pellet> present(s.size());
  double surface = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    Pellet& p = present[s.id[i]];
    p.id = s.id[i];
    p.shape = s.kind[i];
    p.scale = s.scale[i];
    p.pose.position = vec(s.place[i]);
    if (vec(s.velocity[i]).norm() < kSurfaceSpeed) surface = std::max(surface, s.place[i].z + s.place[i].w);
  }
  const std::vector<Pellet> entering = feeder.enter(state.time, present, surface);
  for (const Pellet& pellet : entering) enter(model, state, pellet);
  if (!entering.empty()) state.search_due = 1;
  if (feeder.waiting()) state.waited = 1;
}

void find_pairs(const Model& model, State& state) {
  if (!state.search_due) return;
  state.search_due = 0;
  settle_accounts(state);
  Spheres& s = state.spheres;
  if (model.gear) begin_gear(model, state);
  // who has entered since the last search stands at the end, and has no springs yet
  const Before before = sort_memory(state);
  ++state.searches;
  std::vector<Quad> reach(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double margin = model.skin * s.place[i].w + kHorizonSteps * model.step * vec(s.velocity[i]).norm();
    s.listed_at[i] = {s.place[i].x, s.place[i].y, s.place[i].z, margin * margin};
    reach[i] = {s.place[i].x, s.place[i].y, s.place[i].z, s.place[i].w + margin};
  }
  list_pairs(model, state, reach, before);
  list_walls(model, state, reach, before);
  give_slots(state);
  state.tally.assign(chunks_of(s.size()), SphereTally{});
}

}  // namespace packbed::spheres
