#include "packers/spheres/step.hpp"

#include <algorithm>

#include "math/clock.hpp"
#include "math/simd.hpp"
#include "math/threads.hpp"
#include "packers/run_watch.hpp"
#include "packers/spheres/search.hpp"
#include "packers/spheres/sleep.hpp"

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
  if (model.gear) correct(model, state), add_phase(times[kFinishKick], last);
  state.kick_due = !model.gear;
  sleep(model, state), add_phase(times[kSleep], last);
  rest(model, state, feeder), add_phase(times[kRest], last);
}

SphereView view_of(Spheres& s) {
  return {s.place.data(), s.velocity.data(), s.spin.data(), s.force.data(), s.twist.data()};
}

/// What gravity does to sphere i [m/s2]: nothing when it is fixed.
PACKBED_INLINE Four fall_of(const Four& gravity, const Spheres& s, std::size_t i) {
  return spread_w(s.velocity[i]) > 0.0 ? gravity : Four{};
}

/// Half a step of velocity and spin, by forces that are whole.
PACKBED_INLINE void kick(const Model& model, const Four& gravity, Spheres& s, std::size_t i) {
  const double half = 0.5 * model.step;
  four(s.velocity[i]) += half * (spread_w(s.velocity[i]) * four(s.force[i]) + fall_of(gravity, s, i));
  if (model.turns) four(s.spin[i]) += half * turn_of(s, i);
}

PACKBED_INLINE void gather(const Model& model, State& state, std::size_t i) {
  gather_slots(state, i, state.spheres.force);
  if (model.turns) gather_slots(state, i, state.spheres.twist);
}

/// The second half of the kick of a step.
PACKBED_INLINE void gather_and_kick(const Model& model, const Four& gravity, State& state, std::size_t i) {
  gather(model, state, i);
  kick(model, gravity, state.spheres, i);
}

PACKBED_WIDE bool kick_and_drift(const Model& model, State& state, std::size_t begin, std::size_t end) {
  Spheres& s = state.spheres;
  const Four gravity = four_of(model.gravity);
  const double half = 0.5 * model.step;
  const bool kick_due = state.kick_due;
  bool strayed = false;
  for (std::size_t i = begin; i < end; ++i) {
    if (const std::uint8_t is = state.sleepers.is[i]; is != Sleepers::kAwake) {
      if (is == Sleepers::kShore) clear_forces(model, s, i);
      continue;
    }
    if (is_free(state, i)) {  // what flies does without spin and forces, which need not be fetched
      const Four fall = half * fall_of(gravity, s, i);
      if (kick_due) four(s.velocity[i]) += fall;
      four(s.velocity[i]) += fall;
    } else {
      if (kick_due) gather_and_kick(model, gravity, state, i);
      kick(model, gravity, s, i);
      clear_forces(model, s, i);
    }
    four(s.place[i]) += model.step * without_w(s.velocity[i]);
    strayed |= has_strayed(s, i);
  }
  return strayed;
}

PACKBED_WIDE void finish_kicks(const Model& model, State& state, std::size_t begin, std::size_t end) {
  const Four gravity = four_of(model.gravity);
  for (std::size_t i = begin; i < end; ++i) {
    if (state.sleepers.is[i] == Sleepers::kAwake)
      gather_and_kick(model, gravity, state, i);
    else
      gather(model, state, i);
  }
}

void kick_drift(const Model& model, State& state) {
  for_each_chunk(state.spheres.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    state.strayed[c] = kick_and_drift(model, state, begin, end);
  });
  state.kick_due = 0;
  end_of_drift(model, state);
}

std::vector<Quad> sides_of(const Model& model, const Spheres& s, const List& list, std::size_t from,
                           std::size_t to) {
  std::vector<Quad> sides;
  for (std::size_t p = kLanes * from; p < kLanes * to; ++p) {
    const std::uint32_t i = list.a(p);
    const Quad& x = s.place[i];
    Vec3 normal = Vec3::UnitZ();
    double distance = -kNoWall.w;
    if (list.b(p) == 0) model.solid->side(x.w, Vec3(x.x, x.y, x.z), normal, distance);
    sides.push_back({normal.x(), normal.y(), normal.z(), distance});
  }
  return sides;
}

void touch_container_walls(const Model& model, Spheres& spheres, List& list, double step, std::size_t from,
                           std::size_t to, SphereTally& tally, SphereContact* contacts) {
  const SphereLoops& loops = fastest_sphere_loops();
  const SphereWork work{
      model.wall_law, view_of(spheres), step, blocks_of(list, from, to), list.memory_from(from),
      tally,          contacts};
  if (model.solid)
    loops.touch_given_walls(work, sides_of(model, spheres, list, from, to));
  else
    loops.touch_walls(work, model.walls);
}

void touch(const Model& model, State& state) {
  const SphereLoops& loops = fastest_sphere_loops();
  Spheres& s = state.spheres;
  const SphereView view = view_of(s);
  for_each_chunk(s.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    const auto clear = [&](std::vector<Quad>& of) {  // the slots; the spheres' own are clear since the drift
      std::fill(of.begin() + state.first_slot[c], of.begin() + state.first_slot[c + 1], Quad{});
    };
    clear(s.force);
    if (model.turns) clear(s.twist);
    for (List* list : {&state.pairs, &state.near}) {
      const std::size_t from = list->block_of(begin), to = list->block_of(end);
      loops.touch_spheres({model.pellet_law, view, model.step, blocks_of(*list, from, to),
                           list->memory_from(from), state.tally[c]});
    }
    touch_container_walls(model, s, state.walls, model.step, state.walls.block_of(begin),
                          state.walls.block_of(end), state.tally[c]);
  });
  List &late = state.late.pairs, &late_walls = state.late.walls;
  loops.touch_spheres(
      {model.pellet_law, view, model.step, late.block, late.memory_from(0), state.tally.back()});
  touch_container_walls(model, s, late_walls, model.step, 0, late_walls.block.size(), state.tally.back());
}

void finish_kick(const Model& model, State& state) {
  if (!state.kick_due) return;
  state.kick_due = 0;
  for_each_chunk(state.spheres.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    finish_kicks(model, state, begin, end);
  });
}

void rest(const Model& model, State& state, const Feeder& feeder) {
  if (!feeder.done() || state.time - state.rest.since < model.stepping.rest_window) return;
  finish_kick(model, state);
  const Spheres& s = state.spheres;
  RestLook look(state.rest);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Quad &v = s.velocity[i], &x = s.place[i], &f = s.force[i];
    if (!(v.w > 0)) continue;
    const double weight = model.gravity.norm() / v.w;
    // sleepers have found their balance when they fell asleep
    const double unbalanced =
        !moves(state, i) ? 0.0
                         : (Vec3(f.x, f.y, f.z) + model.gravity / v.w).norm() / std::max(1e-300, weight);
    // what spins on the spot, about the normal of its contact, does so for ever
    look.add(s.id[i], v.x * v.x + v.y * v.y + v.z * v.z, unbalanced, Vec3(x.x, x.y, x.z), 2.0 * x.w);
  }
  look.finish(model.stepping, state.time, false);
  if (model.sleeps && ask_once_more(state.rest)) wake_all(model, state);
}

}  // namespace packbed::spheres
