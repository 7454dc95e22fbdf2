// Phase sleep: spheres that have settled stand still until something would move them, as pellets of the mesh
// packer do (see dynamics/doze.hpp). The pairs between two sleepers leave the loops. What they do to each of
// the two need not be known: together with its listed contacts it kept the sphere in balance when it fell
// asleep, so only the change of the listed ones counts.
#include "packers/spheres/sleep.hpp"

#include <algorithm>
#include <cmath>

#include "math/simd.hpp"
#include "packers/spheres/search.hpp"
#include "packers/spheres/step.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed::spheres {
namespace {

// One sphere in so many may have fallen asleep before all are listed anew, which takes the pairs between
// sleepers out of the loops.
constexpr std::size_t kSleptShare = 32;
// What is out of balance by more than this share of its weight does not fall asleep: a sphere that rolls to
// and fro in a groove stands still at each turn.
constexpr double kUnbalanced = 0.01;
// Change of the force of its contacts, over its weight, by which a sleeper has lost its support.
constexpr double kLostSupport = 0.05;
// What is lighter than this share of the mean mass, by mass, carries next to nothing of the bed.
constexpr double kLight = 0.01;
// Watches after which a light sleeper beside something that moves is woken, to see whether it lies on
// anything.
constexpr std::int64_t kLightSleep = 64;

PACKBED_INLINE double size_of(const Four& v) {
  const Four squares = v * v;
  return std::sqrt(squares[0] + squares[1] + squares[2]);
}

double swing_of(const Model& model, const Spheres& s, std::size_t i) {
  return swing_of(model, s.place[i].w, s.velocity[i].w);
}

PACKBED_INLINE Four slots_of(const State& state, const std::vector<Quad>& of, std::size_t i) {
  Four sum{};
  for (std::uint32_t k = state.slot_first[i]; k < state.slot_first[i + 1]; ++k)
    sum += four(of[state.slot[k]]);
  return sum;
}

/// How far sphere i may go in a watch, and its shadow while it sleeps [m].
PACKBED_INLINE double most_way(const Model& model, const State& state, std::size_t i) {
  return 2.0 * model.stepping.sleep_displacement * state.spheres.place[i].w;
}

/// How far kUnbalanced of its weight moves sphere i in its watch [m].
double way_of_unbalanced(const Model& model, const State& state, std::size_t i) {
  const double time = model.step * static_cast<double>(model.watch << state.sleepers.watch[i]);
  const double gravity = model.gravity.norm();
  return gravity > 0 ? 0.5 * kUnbalanced * gravity * time * time : most_way(model, state, i);
}

/// The mass below which spheres are light [kg]; without gravity none is.
double light_mass(const Model& model, const Spheres& s) {
  if (!(model.gravity.norm() > 0)) return 0;
  double sum = 0, squares = 0;
  for (const Quad& v : s.velocity) {
    if (!(v.w > 0)) continue;
    sum += 1 / v.w;
    squares += 1 / (v.w * v.w);
  }
  return sum > 0 ? kLight * squares / sum : 0;
}

double kinetic_of(const Spheres& s, std::size_t i) {
  const double speed = size_of(four(s.velocity[i])), spin = size_of(four(s.spin[i]));
  return 0.5 * (speed * speed / s.velocity[i].w + spin * spin / s.spin[i].w);
}

/// One step of the shadow of sphere i; true when it has gone too far.
PACKBED_INLINE bool shadow_wakes(const Model& model, State& state, std::size_t i) {
  Sleepers& z = state.sleepers;
  const std::vector<Quad>& forces = state.spheres.force;
  const Four force = four(forces[i]) + slots_of(state, forces, i);
  if (z.other_pairs[i]) four(z.held[i]) = force - four(z.change[i]);
  z.other_pairs[i] = 0;
  four(z.change[i]) = force - four(z.held[i]);
  const double swing = z.rate[i].w;
  const Four push = spread_w(state.spheres.velocity[i]) * four(z.change[i]), rate = without_w(z.rate[i]);
  const Four now = rate + model.step * (push - swing * swing * four(z.shift[i]) - 2.0 * swing * rate);
  four(z.rate[i]) = now + only_w(z.rate[i]);
  four(z.shift[i]) += model.step * now;
  return size_of(four(z.shift[i])) + size_of(now) / swing > most_way(model, state, i);
}

/// True when one of these has to wake.
PACKBED_WIDE bool step_shadows(const Model& model, State& state, std::size_t begin, std::size_t end) {
  bool any_wakes = false;
  for (std::size_t i = begin; i < end; ++i) {
    std::uint8_t& is = state.sleepers.is[i];
    if (is != Sleepers::kShore || !shadow_wakes(model, state, i)) continue;
    is = Sleepers::kWaking;
    any_wakes = true;
  }
  return any_wakes;
}

bool step_all_shadows(const Model& model, State& state) {
  std::vector<std::uint8_t> wakes(chunks_of(state.spheres.size()));
  for_each_chunk(state.spheres.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    wakes[c] = step_shadows(model, state, begin, end);
  });
  return std::find(wakes.begin(), wakes.end(), 1) != wakes.end();
}

/// It goes on as its shadow went, pushed by what is out of balance.
void wake(const Model& model, State& state, std::size_t i) {
  Sleepers& z = state.sleepers;
  Spheres& s = state.spheres;
  z.is[i] = Sleepers::kAwake;
  z.watched[i] = 0;
  --z.count;
  ++z.wakes;
  four(s.velocity[i]) = without_w(z.rate[i]) + only_w(s.velocity[i]);
  z.removed -= kinetic_of(s, i);
  const Four weight = (1.0 / s.velocity[i].w) * four_of(model.gravity);
  four(s.force[i]) = four(z.change[i]) - weight;
  s.twist[i] = {};
}

/// Steps of the watch of a light sphere: so many that what is out of balance goes farther than it may.
std::int64_t light_watch(const Model& model, const State& state, std::size_t i) {
  const double time = std::sqrt(2 * most_way(model, state, i) / (kUnbalanced * model.gravity.norm()));
  std::int64_t steps = model.watch << state.sleepers.watch[i];
  while (model.step * static_cast<double>(steps) < time) steps *= 2;
  return steps;
}

Four force_on(const State& state, std::size_t i) {
  return four(state.spheres.force[i]) + slots_of(state, state.spheres.force, i);
}

/// Whether sphere i touches something, has gone no farther in its watch than `way` [m], and is no faster than
/// `fastest` [m/s].
bool has_stayed(const State& state, std::size_t i, double way, double fastest) {
  const Spheres& s = state.spheres;
  return size_of(force_on(state, i)) > 0 &&
         size_of(four(s.place[i]) - four(state.sleepers.anchor[i])) <= way &&
         size_of(four(s.velocity[i])) <= fastest && size_of(four(s.spin[i])) * s.place[i].w <= fastest;
}

/// A light sphere trembles with all that goes on around it: its weight presses it into its neighbours by less
/// than they swing. So it is not asked to be in balance at the moment, but on the whole of a long watch.
bool has_settled_lightly(const Model& model, const State& state, std::size_t i, std::int64_t watch) {
  const double time = model.step * static_cast<double>(watch);
  return has_stayed(state, i, most_way(model, state, i), 0.5 * kUnbalanced * model.gravity.norm() * time);
}

bool has_settled(const Model& model, const State& state, std::size_t i) {
  const Spheres& s = state.spheres;
  const double limit = std::min(most_way(model, state, i), way_of_unbalanced(model, state, i)),
               gravity = model.gravity.norm();
  const Four unbalanced = spread_w(s.velocity[i]) * force_on(state, i) + four_of(model.gravity);
  return (size_of(unbalanced) <= kUnbalanced * gravity || !(gravity > 0)) &&
         has_stayed(state, i, limit, limit * swing_of(model, s, i));
}

void put_to_sleep(const Model& model, State& state, std::size_t i) {
  Sleepers& z = state.sleepers;
  Spheres& s = state.spheres;
  z.removed += kinetic_of(s, i);
  ++z.count;
  ++z.sleeps;
  ++z.since_search;
  four(s.velocity[i]) = only_w(s.velocity[i]);
  four(s.spin[i]) = only_w(s.spin[i]);
  z.is[i] = Sleepers::kShore;
  z.change[i] = z.shift[i] = {};
  z.rate[i] = {0, 0, 0, swing_of(model, s, i)};
  z.other_pairs[i] = 1;  // those of now
}

bool has_lost_support(const Model& model, const State& state, std::size_t i) {
  const Quad& rate = state.sleepers.rate[i];  // the shadow's place tells of the force without its noise
  return size_of(four(state.sleepers.shift[i])) * rate.w * rate.w > kLostSupport * model.gravity.norm();
}

/// Who has stayed falls asleep, and who has lost what carried it wakes. Large spheres swing slowly and are
/// watched for longer, by powers of two.
void end_watches(const Model& model, State& state) {
  Sleepers& z = state.sleepers;
  const double light_below = light_mass(model, state.spheres);
  for (std::size_t i = 0; i < state.spheres.size(); ++i) {
    const double lightness = state.spheres.velocity[i].w;
    if (!(lightness > 0)) continue;
    const bool light = lightness * light_below > 1;
    const std::int64_t watch = light ? light_watch(model, state, i) : model.watch << z.watch[i];
    if (state.steps % watch != 0) continue;
    const bool looks = light && (state.steps / watch + state.spheres.id[i]) % kLightSleep == 0;
    if (z.is[i] == Sleepers::kShore && (looks || (!light && has_lost_support(model, state, i))))
      z.is[i] = Sleepers::kWaking;
    if (z.is[i] != Sleepers::kAwake) continue;
    const bool settled =
        z.watched[i] && (light ? has_settled_lightly(model, state, i, watch) : has_settled(model, state, i));
    if (settled) {
      put_to_sleep(model, state, i);
    } else {
      z.anchor[i] = state.spheres.place[i];
      z.watched[i] = 1;
    }
  }
  if (z.since_search > state.spheres.size() / kSleptShare) state.search_due = 1;
}

void wake_those_that_must(const Model& model, State& state) {
  Spheres& s = state.spheres;
  std::vector<std::uint32_t> waking;
  for (std::uint32_t i = 0; i < state.spheres.size(); ++i)
    if (state.sleepers.is[i] == Sleepers::kWaking) waking.push_back(i);
  for (const std::uint32_t i : waking) {
    wake(model, state, i);
    four(s.force[i]) -= slots_of(state, s.force, i);  // which are still to be added
    four(s.twist[i]) -= slots_of(state, s.twist, i);
  }
  list_woken(model, state, waking);
}

}  // namespace

void add_sleeper(const Model& model, State& state) {
  Sleepers& z = state.sleepers;
  const std::size_t i = z.is.size();
  const double swing = swing_of(model, state.spheres, i);
  Sleepers::each_of(z, [](auto& of) { of.emplace_back(); });
  if (swing > 0) z.watch[i] = static_cast<std::uint8_t>(std::max(0.0, std::log2(model.swing / swing)));
}

void find_shore(State& state) {
  Sleepers& z = state.sleepers;
  z.since_search = 0;
  if (z.count == 0) return;
  Spheres& s = state.spheres;
  for (std::uint8_t& is : z.is) is = std::min(is, Sleepers::kInland);
  for (const List* list : {&state.pairs, &state.near})
    for (std::size_t p = 0; p < list->lanes(); ++p)
      if (list->a(p) != list->b(p)) come_to_shore(z, list->a(p)), come_to_shore(z, list->b(p));
  for (std::size_t i = 0; i < s.size(); ++i)
    if (z.is[i] == Sleepers::kInland) s.force[i] = s.twist[i] = {};
}

void wake_all(const Model& model, State& state) {
  for (std::size_t i = 0; i < state.spheres.size(); ++i)
    if (state.sleepers.is[i] != Sleepers::kAwake) wake(model, state, i);
  state.search_due = 1;
}

void sleep(const Model& model, State& state) {
  if (!model.sleeps) return;
  bool wakes = state.sleepers.count > 0 && step_all_shadows(model, state);
  if (state.steps % model.watch == 0) {
    end_watches(model, state);
    wakes = true;
  }
  if (wakes) wake_those_that_must(model, state);
}

}  // namespace packbed::spheres
