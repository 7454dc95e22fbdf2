#include "packers/spheres/step.hpp"

#include <algorithm>
#include <atomic>

#include "math/clock.hpp"
#include "math/simd.hpp"
#include "math/threads.hpp"
#include "packers/run_watch.hpp"
#include "packers/spheres/chunks.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed::spheres {
namespace {

std::span<const PairBlock> blocks_of(const List& list, std::size_t from, std::size_t to) {
  return std::span(list.block).subspan(from, to - from);
}

}  // namespace

void step(const Model& model, State& state, Feeder& feeder, PhaseTimes& times) {
  double last = wall_seconds();
  feed(model, state, feeder), add_phase(times[kFeed], last);
  find_pairs(model, state), add_phase(times[kFindPairs], last);
  model.gear ? predict(model, state) : kick_drift(model, state), add_phase(times[kKickDrift], last);
  touch(model, state), add_phase(times[kTouch], last);
  model.gear ? correct(model, state) : gather_kick(model, state), add_phase(times[kGatherKick], last);
  rest(model, state, feeder), add_phase(times[kRest], last);
}

SphereView view_of(Spheres& s) {
  return {s.place.data(), s.velocity.data(), s.spin.data(), s.force.data(), s.twist.data()};
}

PACKBED_WIDE bool kick_and_drift(const Model& model, Spheres& s, std::size_t begin, std::size_t end) {
  const double step = model.step, half = 0.5 * step;
  const Four gravity = four_of(model.gravity);
  bool left_margin = false;
  for (std::size_t i = begin; i < end; ++i) {
    const Four inverse_mass = spread_w(s.velocity[i]);
    const Four kick = half * (inverse_mass * four(s.force[i]) + (inverse_mass > 0.0 ? gravity : Four{}));
    four(s.velocity[i]) += kick;
    four(s.place[i]) += step * without_w(s.velocity[i]);
    if (model.turns) four(s.spin[i]) += half * turn_of(s, i);
    left_margin |= way_from(s.place[i], s.listed_at[i]) > s.listed_at[i].w;
  }
  return left_margin;
}

PACKBED_WIDE void gather_and_kick(const Model& model, State& state, std::size_t begin, std::size_t end) {
  Spheres& s = state.spheres;
  const double half = 0.5 * model.step;
  const Four gravity = four_of(model.gravity);
  for (std::size_t i = begin; i < end; ++i) {
    gather_slots(state, i, s.force);
    const Four inverse_mass = spread_w(s.velocity[i]);
    four(s.velocity[i]) += half * (inverse_mass * four(s.force[i]) + (inverse_mass > 0.0 ? gravity : Four{}));
    if (!model.turns) continue;
    gather_slots(state, i, s.twist);
    four(s.spin[i]) += half * turn_of(s, i);
  }
}

void kick_drift(const Model& model, State& state) {
  std::atomic<bool> left_margin{false};
  for_each_chunk(state.spheres.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    if (kick_and_drift(model, state.spheres, begin, end)) left_margin.store(true, std::memory_order_relaxed);
  });
  end_of_drift(model, state, left_margin);
}

std::vector<Quad> sides_of(const Model& model, const State& state, std::size_t from, std::size_t to) {
  const Spheres& s = state.spheres;
  std::vector<Quad> sides;
  for (std::size_t p = 4 * from; p < 4 * to; ++p) {
    const std::uint32_t i = state.walls.a(p);
    const Quad& x = s.place[i];
    Vec3 normal = Vec3::UnitZ();
    double distance = -kNoWall.w;
    if (state.walls.b(p) == 0) model.solid->side(x.w, Vec3(x.x, x.y, x.z), normal, distance);
    sides.push_back({normal.x(), normal.y(), normal.z(), distance});
  }
  return sides;
}

void touch_container_walls(const Model& model, State& state, const SphereView& view, double step,
                           std::size_t from, std::size_t to, SphereTally& tally, SphereContact* contacts) {
  const std::span<const PairBlock> blocks = blocks_of(state.walls, from, to);
  const SphereMemory memory = state.walls.memory_from(from);
  if (model.solid)
    touch_given_walls(model.wall_law, view, step, sides_of(model, state, from, to), blocks, memory, tally,
                      contacts);
  else
    touch_walls(model.wall_law, view, step, model.walls, blocks, memory, tally, contacts);
}

void touch(const Model& model, State& state) {
  Spheres& s = state.spheres;
  const SphereView view = view_of(s);
  for_each_chunk(s.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    const auto clear = [&](std::vector<Quad>& of) {
      std::fill(of.begin() + static_cast<std::ptrdiff_t>(begin),
                of.begin() + static_cast<std::ptrdiff_t>(end), Quad{});
      std::fill(of.begin() + state.first_slot[c], of.begin() + state.first_slot[c + 1], Quad{});
    };
    clear(s.force);
    if (model.turns) clear(s.twist);
    const std::size_t from = state.pairs.first[begin] / 4, to = state.pairs.first[end] / 4;
    touch_spheres(model.pellet_law, view, model.step, blocks_of(state.pairs, from, to),
                  state.pairs.memory_from(from), state.tally[c]);
    touch_container_walls(model, state, view, model.step, state.walls.first[begin] / 4,
                          state.walls.first[end] / 4, state.tally[c]);
  });
}

void gather_kick(const Model& model, State& state) {
  for_each_chunk(state.spheres.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    gather_and_kick(model, state, begin, end);
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
