// Phase touch: every pair that may have come into contact is looked at, and its forces go into its own slot.
#include <algorithm>

#include "math/threads.hpp"
#include "packers/mesh/kernels.hpp"
#include "packers/mesh/step.hpp"

namespace packbed::mesh {
namespace {

/// Motion of a against b at the touch. What is not awake stands still; b may be the container.
Approach approach_of(const Model& model, const Bodies& bodies, const Touch& t, std::uint32_t a,
                     std::uint32_t b) {
  Approach out;
  const double half_step = 0.5 * model.step;
  const auto add = [&](std::uint32_t i, double side, const Vec3& torque) {
    const Vec3 turned = inverse_inertia_times(bodies, i, torque);
    out.inverse_mass += bodies.inverse_mass[i] * t.gradient.squaredNorm() + torque.dot(turned);
    if (bodies.motion[i] != Motion::awake) return;
    // the dashpot acts at the end of the step: velocities there, from the last known accelerations
    const Vec3 velocity =
        bodies.velocity[i] + half_step * (bodies.inverse_mass[i] * bodies.force[i] + model.gravity);
    out.closing -= side * t.gradient.dot(velocity) + torque.dot(bodies.spin[i]) +
                   half_step * turned.dot(bodies.torque[i]);
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

void look(const Model& model, State& state, std::uint32_t p) {
  const Bodies& bodies = state.bodies;
  const auto [a, b] = state.pairs.pair[p];
  const bool wall = is_container(b);
  const double travelled = bodies.travel[a] + (wall ? 0.0 : bodies.travel[b]);
  if (travelled < state.pairs.look_at[p]) return;
  PairRecord& r = state.pairs.record[p];
  double gap = 0;
  const Touch t = touch_pair(model, bodies, state.pairs.pair[p], travelled, r, gap);
  if (!(t.delta > 0)) {
    if (r.delta > 0) part(r);
    state.pairs.look_at[p] = travelled + std::max(0.0, gap);
    return;
  }
  const LawNumbers& law = wall ? model.wall_law : model.pellet_law;
  const ContactForce f = resolve(t, law, approach_of(model, bodies, t, a, b), model.step, r.spring);
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
  ++r.looks;
  r.deep_looks += depth > 0.05;
  r.very_deep_looks += depth > 0.1;
}

}  // namespace

void touch(const Model& model, State& state) {
  const std::vector<std::uint32_t>& active = state.pairs.active;
  parallel_for(active.size(), 64, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) look(model, state, active[k]);
  });
}

}  // namespace packbed::mesh
