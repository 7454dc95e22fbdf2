#include "packers/mesh/push.hpp"

#include <algorithm>

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

/// R* of rolling friction.
double reduced_radius(const Model& model, const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  const auto of = [&](std::uint32_t i) { return bodies.scale[i] * model.kinds[bodies.kind[i]].radius; };
  return is_container(b) ? of(a) : of(a) * of(b) / (of(a) + of(b));
}

double thickness_of(const Model& model, const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  const auto of = [&](std::uint32_t i) { return bodies.scale[i] * model.kinds[bodies.kind[i]].thickness; };
  return is_container(b) ? of(a) : std::min(of(a), of(b));
}

}  // namespace

double push(const Model& model, const Bodies& bodies, const BodyPair& pair, const Touch& t, Spring& spring,
            Load& load, PairRecord& r) {
  const auto [a, b] = pair;
  const bool wall = is_container(b);
  const LawNumbers& law = wall ? model.wall_law : model.pellet_law;
  Approach approach = approach_of(bodies, t, a, b);
  approach.radius = reduced_radius(model, bodies, a, b);
  const ContactForce f = resolve(t, law, approach, model.step, spring);
  load.force += f.push * t.gradient + f.friction;
  load.torque_a += f.push * t.torque_a + (t.point - bodies.position[a]).cross(f.friction) + f.moment;
  if (!wall)
    load.torque_b += f.push * t.torque_b - (t.point - bodies.position[b]).cross(f.friction) - f.moment;
  r.point = t.point;
  r.elastic += f.elastic;
  r.damped += f.damped;
  r.rubbed += f.rubbed;
  return f.elastic - 0.5 * law.stiffness * t.share * t.delta * t.delta;
}

void count_touch(const Model& model, const Bodies& bodies, const BodyPair& pair, double depth,
                 PairRecord& r) {
  const double fraction = depth / thickness_of(model, bodies, pair.a, pair.b);
  r.peak = std::max(r.peak, fraction);
  ++r.touches;
  r.deep_touches += fraction > 0.05;
}

void part(Load& load, PairRecord& r) {
  // what was still stored while the dashpot held the spring back has gone into it
  if (load.force.isZero(0)) r.damped += r.elastic;
  load = Load{};
  r.spring = Spring{};
  r.elastic = 0;
}

}  // namespace packbed::mesh
