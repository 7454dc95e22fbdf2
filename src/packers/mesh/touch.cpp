// Phase touch: every pair that may have come into contact is looked at, and its forces go into its own slot.
#include <algorithm>

#include "math/threads.hpp"
#include "packers/mesh/kernels.hpp"
#include "packers/mesh/step.hpp"

namespace packbed::mesh {
namespace {

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
void part(PairRecord& r) {
  if (r.force.isZero(0)) r.damped += r.elastic;
  r.spring = Spring{};
  r.force.setZero();
  r.torque_a.setZero();
  r.torque_b.setZero();
  r.elastic = 0;
  r.delta = 0;
}

double thickness_of(const Model& model, const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  const double of_a = model.kinds[bodies.kind[a]].thickness;
  return is_container(b) ? of_a : std::min(of_a, model.kinds[bodies.kind[b]].thickness);
}

void push(const Model& model, const Bodies& bodies, const BodyPair& pair, const Touch& t, PairRecord& r) {
  const auto [a, b] = pair;
  const bool wall = is_container(b);
  const LawNumbers& law = wall ? model.wall_law : model.pellet_law;
  const ContactForce f = resolve(t, law, approach_of(bodies, t, a, b), model.step, r.spring);
  r.force = f.push * t.gradient + f.friction;
  r.torque_a = f.push * t.torque_a + (t.point - bodies.position[a]).cross(f.friction) + f.moment;
  if (!wall) r.torque_b = f.push * t.torque_b - (t.point - bodies.position[b]).cross(f.friction) - f.moment;
  r.point = t.point;
  r.elastic = f.elastic;
  r.damped += f.damped;
  r.rubbed += f.rubbed;
  r.delta = t.delta;
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

void take(const Model& model, State& state, std::uint32_t p, const Touch& t, double look_at) {
  PairRecord& r = state.pairs.record[p];
  if (t.delta > 0) {
    push(model, state.bodies, state.pairs.pair[p], t, r);
    return;
  }
  if (r.delta > 0) part(r);
  state.pairs.look_at[p] = look_at;
}

void look_afresh(const Model& model, State& state, std::uint32_t p, double travelled) {
  double gap = 0;
  const Touch t = touch_pair(model, state.bodies, state.pairs.pair[p], travelled, state.pairs.record[p], gap);
  take(model, state, p, t, travelled + std::max(0.0, gap));
}

/// The pairs of cylinders that were queued.
void look_at_rods(const Model& model, State& state, RodLooks& looks) {
  looks.finish([&](std::uint32_t p, const Touch& t, bool lost) {
    if (lost)
      look_afresh(model, state, p, travel_of(state, p));
    else
      take(model, state, p, t, state.pairs.record[p].features.due());
  });
}

void look(const Model& model, State& state, std::uint32_t p, RodLooks& looks) {
  const double travelled = travel_of(state, p);
  if (travelled < state.pairs.look_at[p]) return;
  PairRecord& r = state.pairs.record[p];
  if (!r.features.known) {
    look_afresh(model, state, p, travelled);
    return;
  }
  const auto [a, b] = state.pairs.pair[p];
  looks.add(p, rod_of(model, state.bodies, a), rod_of(model, state.bodies, b), travelled, r.features);
  if (looks.full()) look_at_rods(model, state, looks);
}

}  // namespace

void touch(const Model& model, State& state) {
  const std::vector<std::uint32_t>& active = state.pairs.active;
  state.ledger.active += static_cast<double>(active.size());
  parallel_for(active.size(), 64, [&](std::size_t from, std::size_t to) {
    thread_local RodLooks looks;
    for (std::size_t k = from; k < to; ++k) look(model, state, active[k], looks);
    look_at_rods(model, state, looks);
  });
}

}  // namespace packbed::mesh
