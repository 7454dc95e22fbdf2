// Phase touch: every pair that may have come into contact is looked at, and its forces go into its own slot.
#include <algorithm>

#include "math/threads.hpp"
#include "packers/mesh/kernels.hpp"
#include "packers/mesh/step.hpp"

namespace packbed::mesh {
namespace {

// Pairs between the one looked at and the one whose record is fetched.
constexpr std::size_t kAhead = 6;

/// Motion of a against b at the touch. What is not awake stands still; b may be the container.
Approach approach_of(const Bodies& bodies, const Touch& t, std::uint32_t a, std::uint32_t b) {
  Approach out;
  const auto add = [&](std::uint32_t i, double side, const Vec3& torque) {
    out.inverse_mass += bodies.inverse_mass[i] * t.gradient.squaredNorm() +
                        torque.dot(inverse_inertia_times(bodies, i, torque));
    out.closing -= side * t.gradient.dot(bodies.velocity_ahead[i]) + torque.dot(bodies.spin_ahead[i]);
    out.closing_mid -= side * t.gradient.dot(bodies.velocity[i]) + torque.dot(bodies.spin[i]);
    out.slide += side * (bodies.velocity[i] + bodies.spin[i].cross(t.point - bodies.position[i]));
    out.spin += side * bodies.spin[i];
  };
  add(a, 1.0, t.torque_a);
  if (!is_container(b)) add(b, -1.0, t.torque_b);
  const double length = t.gradient.norm();
  if (length > 0) out.turn = out.spin.dot(t.gradient) / length;
  return out;
}

/// The pair has come apart. What was still stored while the dashpot held the spring back has gone into it.
void part(Load& load, PairRecord& r) {
  if (load.force.isZero(0)) r.damped += r.elastic;
  load = Load{};
  r.spring = Spring{};
  r.elastic = 0;
}

/// R* of rolling friction.
double reduced_radius(const Model& model, const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  const auto of = [&](std::uint32_t i) { return bodies.scale[i] * model.kinds[bodies.kind[i]].radius; };
  return is_container(b) ? of(a) : of(a) * of(b) / (of(a) + of(b));
}

double thickness_of(const Model& model, const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  const auto of = [&](std::uint32_t i) { return bodies.scale[i] * model.kinds[bodies.kind[i]].thickness; };
  return is_container(b) ? of(a) : std::min(of(a), of(b));
}

void push(const Model& model, const Bodies& bodies, const BodyPair& pair, const Touch& t, Load& load,
          PairRecord& r) {
  const auto [a, b] = pair;
  const bool wall = is_container(b);
  const LawNumbers& law = wall ? model.wall_law : model.pellet_law;
  Approach approach = approach_of(bodies, t, a, b);
  approach.radius = reduced_radius(model, bodies, a, b);
  const ContactForce f = resolve(t, law, approach, model.step, r.spring);
  load.force = f.push * t.gradient + f.friction;
  load.torque_a = f.push * t.torque_a + (t.point - bodies.position[a]).cross(f.friction) + f.moment;
  if (!wall)
    load.torque_b = f.push * t.torque_b - (t.point - bodies.position[b]).cross(f.friction) - f.moment;
  r.point = t.point;
  r.elastic = f.elastic;
  r.damped += f.damped;
  r.rubbed += f.rubbed;
  load.delta = t.delta;
  const double depth = t.depth / thickness_of(model, bodies, a, b);
  r.peak = std::max(r.peak, depth);
  ++r.touches;
  r.deep_touches += depth > 0.05;
  r.very_deep_touches += depth > 0.1;
}

double travel_of(const State& state, std::uint32_t p) {
  const auto [a, b] = state.pairs.pair[p];
  const std::vector<double>& travel = state.bodies.travel;
  return travel[a] + (is_container(b) ? 0.0 : travel[b]);
}

void take(const Model& model, State& state, std::uint32_t p, const Touch& t, double gap) {
  PairRecord& r = state.pairs.record[p];
  Load& load = state.pairs.load[p];
  if (t.delta > 0) {
    push(model, state.bodies, state.pairs.pair[p], t, load, r);
    return;
  }
  if (load.delta > 0) part(load, r);
  state.pairs.look_at[p] = travel_of(state, p) + std::max(0.0, gap);
}

void look_afresh(const Model& model, State& state, std::uint32_t p) {
  double gap = 0;
  const Touch t = touch_pair(model, state.bodies, state.pairs.pair[p], state.pairs.record[p], gap);
  take(model, state, p, t, gap);
}

/// The pairs of cylinders that were queued.
void look_at_rods(const Model& model, State& state, RodLooks& looks) {
  looks.finish([&](std::uint32_t p, const Touch& t, bool lost) {
    if (lost)
      look_afresh(model, state, p);
    else
      take(model, state, p, t, state.pairs.record[p].features.due());
  });
}

/// The record of a pair, soon to be used, on its way into the cache.
void fetch(const PairRecord& record) {
  const auto* line = reinterpret_cast<const char*>(&record);
  for (std::size_t at = 0; at < sizeof(PairRecord); at += 64) __builtin_prefetch(line + at, 1);
}

void look(const Model& model, State& state, std::uint32_t p, RodLooks& looks) {
  PairRecord& r = state.pairs.record[p];
  if (!r.features.known) {
    look_afresh(model, state, p);
    return;
  }
  const auto [a, b] = state.pairs.pair[p];
  looks.add(p, rod_of(model, state.bodies, a), rod_of(model, state.bodies, b), r.features);
  if (looks.full()) look_at_rods(model, state, looks);
}

}  // namespace

void touch(const Model& model, State& state) {
  const std::vector<std::uint32_t>& active = state.pairs.active;
  state.ledger.active += static_cast<double>(active.size());
  parallel_for_uneven(active.size(), 64, [&](std::size_t from, std::size_t to) {
    thread_local RodLooks looks;
    thread_local std::vector<std::uint32_t> due;
    due.clear();
    for (std::size_t k = from; k < to; ++k)
      if (travel_of(state, active[k]) >= state.pairs.look_at[active[k]]) due.push_back(active[k]);
    for (std::size_t k = 0; k < due.size(); ++k) {
      if (k + kAhead < due.size()) fetch(state.pairs.record[due[k + kAhead]]);
      look(model, state, due[k], looks);
    }
    look_at_rods(model, state, looks);
  });
}

}  // namespace packbed::mesh
