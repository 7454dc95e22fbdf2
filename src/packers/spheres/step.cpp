#include "packers/spheres/step.hpp"

#include <algorithm>
#include <atomic>

#include "math/clock.hpp"
#include "math/threads.hpp"
#include "packers/run_watch.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed::spheres {
namespace {

PACKBED_INLINE Four four_of(const Vec3& v) {
  return Four{v.x(), v.y(), v.z(), 0.0};
}
PACKBED_INLINE Four spread_w(const Four& v) {
  return __builtin_shufflevector(v, v, 3, 3, 3, 3);
}

/// Calls body(begin, end) for each chunk of spheres.
template <class Body>
void for_each_chunk(std::size_t spheres, const Body& body) {
  parallel_for(chunks_of(spheres), 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t c = from; c < to; ++c) body(c, c * kChunk, std::min(spheres, (c + 1) * kChunk));
  });
}

template <class Pair>
std::span<const Pair> pairs_of(const List<Pair>& list, std::size_t begin, std::size_t end) {
  return std::span(list.pair).subspan(list.first[begin], list.first[end] - list.first[begin]);
}

}  // namespace

void step(const Model& model, State& state, Feeder& feeder, PhaseTimes& times) {
  double last = wall_seconds();
  feed(model, state, feeder), add_phase(times[kFeed], last);
  find_pairs(model, state), add_phase(times[kFindPairs], last);
  kick_drift(model, state), add_phase(times[kKickDrift], last);
  touch(model, state), add_phase(times[kTouch], last);
  gather_kick(model, state), add_phase(times[kGatherKick], last);
  rest(model, state, feeder), add_phase(times[kRest], last);
}

SphereView view_of(Spheres& s) {
  return {s.place.data(), s.velocity.data(), s.ahead.data(), s.spin.data(), s.force.data(), s.torque.data()};
}

void kick_drift(const Model& model, State& state) {
  Spheres& s = state.spheres;
  const double step = model.step, half = 0.5 * step;
  const Four gravity = four_of(model.gravity);
  std::atomic<bool> left_margin{false};
  for_each_chunk(s.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    bool left = false;
    for (std::size_t i = begin; i < end; ++i) {
      const Four inverse_mass = spread_w(four(s.velocity[i]));
      Four kick = half * (inverse_mass * four(s.force[i]) + (inverse_mass > 0.0 ? gravity : Four{}));
      four(s.velocity[i]) += kick;
      four(s.ahead[i]) = four(s.velocity[i]) + kick;
      four(s.place[i]) += step * Four{s.velocity[i].x, s.velocity[i].y, s.velocity[i].z, 0.0};
      if (model.turns) four(s.spin[i]) += half * spread_w(four(s.spin[i])) * four(s.torque[i]);
      const Four way = four(s.place[i]) - four(s.listed_at[i]);
      left |= way[0] * way[0] + way[1] * way[1] + way[2] * way[2] > s.listed_at[i].w;
    }
    if (left) left_margin.store(true, std::memory_order_relaxed);
  });
  ++state.steps;
  state.time += step;
  state.ledger.listed += static_cast<double>(state.pairs.pair.size());
  if (left_margin) state.search_due = 1;
}

void touch(const Model& model, State& state) {
  Spheres& s = state.spheres;
  const SphereView view = view_of(s);
  for_each_chunk(s.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    const auto clear = [&](std::vector<Quad>& of) {
      std::fill(of.begin() + static_cast<std::ptrdiff_t>(begin),
                of.begin() + static_cast<std::ptrdiff_t>(end), Quad{});
    };
    clear(s.force);
    if (model.turns) clear(s.torque);
    for (const SpherePair& p : pairs_of(state.pairs, begin, end)) {
      if (p.to == p.b) continue;
      s.force[p.to] = Quad{};
      if (model.turns) s.torque[p.to] = Quad{};
    }
    touch_spheres(model.pellet_law, view, model.step, pairs_of(state.pairs, begin, end),
                  state.pairs.memory_from(state.pairs.first[begin]), state.tally[c]);
    touch_walls(model.wall_law, view, model.step, model.walls, pairs_of(state.walls, begin, end),
                state.walls.memory_from(state.walls.first[begin]), state.tally[c]);
  });
}

void gather_kick(const Model& model, State& state) {
  Spheres& s = state.spheres;
  const double half = 0.5 * model.step;
  const Four gravity = four_of(model.gravity);
  for_each_chunk(s.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::uint32_t k = state.slot_first[i]; k < state.slot_first[i + 1]; ++k) {
        four(s.force[i]) += four(s.force[state.slot[k]]);
        if (model.turns) four(s.torque[i]) += four(s.torque[state.slot[k]]);
      }
      const Four inverse_mass = spread_w(four(s.velocity[i]));
      four(s.velocity[i]) +=
          half * (inverse_mass * four(s.force[i]) + (inverse_mass > 0.0 ? gravity : Four{}));
      if (model.turns) four(s.spin[i]) += half * spread_w(four(s.spin[i])) * four(s.torque[i]);
    }
  });
}

void rest(const Model& model, State& state, const Feeder& feeder) {
  if (!feeder.done() || state.time - state.rest.since < model.stepping.rest_window) return;
  const Spheres& s = state.spheres;
  RestLook look(state.rest);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Quad &v = s.velocity[i], &w = s.spin[i], &x = s.place[i], &f = s.force[i];
    if (!(v.w > 0)) continue;
    const double turning = w.w > 0 ? (w.x * w.x + w.y * w.y + w.z * w.z) * v.w / w.w : 0.0;
    const double weight = model.gravity.norm() / v.w;
    const double unbalanced = (Vec3(f.x, f.y, f.z) + model.gravity / v.w).norm() / std::max(1e-300, weight);
    look.add(s.id[i], v.x * v.x + v.y * v.y + v.z * v.z + turning, unbalanced, Vec3(x.x, x.y, x.z),
             2.0 * x.w);
  }
  look.finish(model.stepping, state.time, false);
}

}  // namespace packbed::spheres
