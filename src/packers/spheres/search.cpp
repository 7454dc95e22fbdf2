// Phases feed and find_pairs: who is in the scene, and who may touch whom before the next search.
#include <algorithm>
#include <numeric>
#include <optional>

#include "math/threads.hpp"
#include "packers/spheres/account.hpp"
#include "packers/spheres/search.hpp"
#include "packers/spheres/sleep.hpp"
#include "packers/spheres/step.hpp"

namespace packbed::spheres {
namespace {

// A sphere may go this many steps at its present speed before it is listed anew: rarer searches, longer
// lists. Around one that flies there may be much room, and then more is better.
constexpr double kHorizonSteps = 60, kMostFlightSteps = 2000;
// Pairs of flying spheres over their number, between which the flight steps are left as they are.
constexpr double kFewNear = 0.2, kManyNear = 0.4;
// What moves faster is not part of the bed's surface [m/s].
constexpr double kSurfaceSpeed = 0.2;

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
  s.listed_at.push_back(quad(pellet.pose.position, 0));
  state.rest.anchor.push_back(pellet.pose.position);
  add_sleeper(model, state);
  if (pellet.fixed) return;
  state.ledger.input += 0.5 * mass * pellet.velocity.squaredNorm() +
                        0.5 * inertia * pellet.spin.squaredNorm() -
                        mass * model.gravity.dot(pellet.pose.position);
}

/// Partners that the spheres of a chunk have found, one after the other, and how many each.
struct Found {
  std::vector<std::uint32_t> partner, count;
};

/// The list of all chunks, with nothing to remember yet. A lane of no use names `idle`, or without one its
/// own sphere.
List listed(const std::vector<Found>& found, std::size_t spheres, const Model& model,
            std::optional<std::uint32_t> idle) {
  std::vector<std::size_t> first_block(1, 0);
  for (const Found& f : found)
    first_block.push_back(first_block.back() + (f.partner.size() + kLanes - 1) / kLanes);
  List list;
  list.block.resize(first_block.back());
  list.first.resize(spheres + 1);
  list.first[spheres] = list.filled = static_cast<std::uint32_t>(list.lanes());
  for_each_chunk(spheres, [&](std::size_t c, std::size_t begin, std::size_t end) {
    std::size_t p = kLanes * first_block[c];
    auto partner = found[c].partner.begin();
    for (std::size_t i = begin; i < end; ++i) {
      const auto a = static_cast<std::uint32_t>(i);
      list.first[i] = static_cast<std::uint32_t>(p);
      for (std::uint32_t n = 0; n < found[c].count[i - begin]; ++n)
        put(list, p++, a, *partner++, idle.value_or(a));
    }
  });
  make_memory(model, list);
  return list;
}

void list_pairs(const Model& model, State& state, const LevelGrid& grid, const Before& before) {
  const Spheres& s = state.spheres;
  std::vector<Found> touching(chunks_of(s.size())), others(touching), still(touching);
  for_each_chunk(s.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::vector<Found>* of : {&touching, &others, &still}) (*of)[c].count.push_back(0);
      const auto add = [&](Found& to, std::uint32_t j) { to.partner.push_back(j), ++to.count.back(); };
      grid.for_each_near(static_cast<std::uint32_t>(i), [&](std::uint32_t j) {
        if (!(s.velocity[i].w > 0 || s.velocity[j].w > 0)) return;
        const bool touches = meet(s.place[i], s.place[j]);
        if (moves(state, i) || moves(state, j))
          add((touches ? touching : others)[c], j);
        else if (touches)
          add(still[c], j);
      });
    }
  });
  const OldLists old({&state.pairs, &state.near, &state.still}, state.late.pairs);
  state.pairs = listed(touching, s.size(), model, {});
  state.near = listed(others, s.size(), model, {});
  state.still = listed(still, s.size(), model, {});
  for (List* list : {&state.pairs, &state.near, &state.still})
    parallel_for(list->lanes(), 4096, [&](std::size_t from, std::size_t to) {
      for (std::size_t p = from; p < to; ++p) {
        const std::uint32_t a = before[list->a(p)], b = before[list->b(p)];
        if (a != b && !old.hand_over(a, b, 1.0, *list, p)) old.hand_over(b, a, -1.0, *list, p);
      }
    });
}

void list_walls(const Model& model, State& state, const std::vector<Quad>& reach, const Before& before) {
  const Spheres& s = state.spheres;
  std::vector<Found> found(chunks_of(s.size())), still(found);
  for_each_chunk(s.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      found[c].count.push_back(0), still[c].count.push_back(0);
      if (!(s.velocity[i].w > 0)) continue;
      Found& to = (moves(state, i) ? found : still)[c];
      for_each_wall_near(model, reach[i], [&](std::uint32_t wall) {
        to.partner.push_back(wall);
        ++to.count.back();
      });
    }
  });
  const OldLists old({&state.walls, &state.still_walls}, state.late.walls);
  state.walls = listed(found, s.size(), model, idle_wall(model));
  state.still_walls = listed(still, s.size(), model, idle_wall(model));
  for (List* list : {&state.walls, &state.still_walls})
    for (std::size_t p = 0; p < list->lanes(); ++p)
      old.hand_over(before[list->a(p)], list->b(p), 1.0, *list, p);
}

/// Whether sphere i moves and nothing pushed it at the end of the last step.
bool flies(const State& state, std::size_t i) {
  return moves(state, i) && vec(state.spheres.force[i]).isZero(0);
}

void adapt_flight(State& state) {
  std::vector<std::size_t> flying_in(chunks_of(state.spheres.size())), pairs_in(flying_in);
  for_each_chunk(state.spheres.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) flying_in[c] += flies(state, i);
    for (std::size_t p = kLanes * state.near.block_of(begin); p < kLanes * state.near.block_of(end); ++p)
      pairs_in[c] += flies(state, state.near.a(p)) || flies(state, state.near.b(p));
  });
  const std::size_t flying = std::accumulate(flying_in.begin(), flying_in.end(), std::size_t{1}),
                    pairs = std::accumulate(pairs_in.begin(), pairs_in.end(), std::size_t{0});
  const double near = static_cast<double>(pairs) / static_cast<double>(flying);
  if (near > kManyNear) state.flight_steps = std::max(kHorizonSteps, state.flight_steps / 1.5);
  if (near < kFewNear) state.flight_steps = std::min(kMostFlightSteps, state.flight_steps * 1.25);
}

}  // namespace

void settle_accounts(State& state) {
  auto& l = state.ledger;
  for (SphereTally& t : state.tally) {
    l.damped += total(t.damped);
    l.rubbed += total(t.rubbed);
    for (const double deepest : t.deepest.value) l.peak = std::max(l.peak, deepest);
    l.touches += total(t.touches);
    l.deep += total(t.deep);
    t = SphereTally{};
  }
}

void feed(const Model& model, State& state, Feeder& feeder) {
  if (state.time + 0.5 * model.step < feeder.next_time()) return;
  finish_kick(model, state);
  const Spheres& s = state.spheres;
  double surface = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
    if (vec(s.velocity[i]).norm() < kSurfaceSpeed) surface = std::max(surface, s.place[i].z + s.place[i].w);
  const std::vector<Pellet> entering = feeder.enter(state.time, pellets_of(state), surface);
  for (const Pellet& pellet : entering) enter(model, state, pellet);
  if (!entering.empty()) state.search_due = 1;
  if (feeder.waiting()) state.waited = 1;
}

void give_margin(const Model& model, State& state, std::size_t i, bool flies) {
  Spheres& s = state.spheres;
  const Quad& x = s.place[i];
  const double steps = flies ? state.flight_steps : kHorizonSteps;
  const double margin = model.skin * x.w + steps * model.step * vec(s.velocity[i]).norm();
  s.listed_at[i] = {x.x, x.y, x.z, margin * margin};
}

void find_pairs(const Model& model, State& state) {
  const bool strayed = std::find(state.strayed.begin(), state.strayed.end(), 1) != state.strayed.end();
  if (!state.search_due && (!strayed || relist(model, state))) return;
  finish_kick(model, state);
  state.search_due = 0;
  settle_accounts(state);
  Spheres& s = state.spheres;
  if (model.gear) begin_gear(model, state);
  // who has entered since the last search stands at the end, and has no springs yet
  const Before before = sort_memory(state);
  ++state.searches;
  Late& late = state.late;
  late.reach.resize(s.size());
  for_each_chunk(s.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      give_margin(model, state, i, flies(state, i));
      late.reach[i] = ball_of(s, i);
    }
  });
  late.grid = std::make_shared<LevelGrid>(late.reach);
  list_pairs(model, state, *late.grid, before);
  list_walls(model, state, late.reach, before);
  give_slots(state);
  find_shore(state);
  adapt_flight(state);
  late.pairs = {}, late.walls = {};
  late.chains = chains_of(late.pairs, s.size());
  late.moved.clear();
  late.woken = 0;
  state.strayed.assign(chunks_of(s.size()), 0);
  state.tally.assign(chunks_of(s.size()) + 1, SphereTally{});  // the last one is that of the late pairs
}

}  // namespace packbed::spheres
