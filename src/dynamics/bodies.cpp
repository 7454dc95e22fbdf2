#include "dynamics/bodies.hpp"

#include <cmath>

#include "math/trig.hpp"

namespace packbed {
namespace {

/// The rotation by `angle` about a unit vector.
Quat turn(const Vec3& axis, double angle) {
  double s, c;
  sincos_poly(0.5 * angle, s, c);
  return Quat(c, s * axis.x(), s * axis.y(), s * axis.z());
}

bool symmetric(const Vec3& inertia) {
  return std::abs(inertia.x() - inertia.y()) <= 1e-12 * inertia.x();
}

/// Free symmetric top: turns about L by |L|/It and about its own axis by the rest of the spin, both uniform.
void turn_symmetric(Quat& q, const Vec3& momentum, const Vec3& axis, const Vec3& inverse, double step) {
  const double length = momentum.norm();
  if (!(length > 0)) return;
  const double own = momentum.dot(axis) * (inverse.z() - inverse.x());
  q = turn(momentum / length, length * inverse.x() * step) * (q * turn(Vec3::UnitZ(), own * step));
}

/// Half turns about x, y, a whole one about z, half turns back: symmetric, so second order and reversible.
void turn_asymmetric(Quat& q, const Vec3& momentum, const Vec3& inverse, double step) {
  Vec3 l = q.conjugate() * momentum;  // in the body
  const auto about = [&](int k, double time) {
    const Vec3 axis = Vec3::Unit(k);
    const double angle = l[k] * inverse[k] * time;
    const Quat t = turn(axis, angle);
    l = t.conjugate() * l;
    q = q * t;
  };
  about(0, 0.5 * step);
  about(1, 0.5 * step);
  about(2, step);
  about(1, 0.5 * step);
  about(0, 0.5 * step);
}

void renormalise(
    Quat& q) {  // one Newton step for 1/|q|: exact to rounding, as |q| is 1 within rounding before
  q.coeffs() *= 1.5 - 0.5 * q.squaredNorm();
}

}  // namespace

void add_body(Bodies& b, const NewBody& n) {
  b.kind.push_back(n.kind);
  b.mass.push_back(n.mass);
  b.inverse_mass.push_back(n.fixed ? 0.0 : 1.0 / n.mass);
  b.inertia.push_back(n.inertia);
  b.inverse_inertia.push_back(n.fixed ? Vec3(Vec3::Zero()) : Vec3(n.inertia.cwiseInverse()));
  b.bounding_radius.push_back(n.bounding_radius);
  b.scale.push_back(n.scale);
  b.position.push_back(n.pose.position);
  b.rotation.push_back(n.pose.rotation.normalized());
  b.axis.push_back(b.rotation.back() * Vec3::UnitZ());
  b.velocity.push_back(n.velocity);
  const Quat& q = b.rotation.back();
  b.angular_momentum.push_back(q * Vec3(n.inertia.cwiseProduct(q.conjugate() * n.spin)));
  b.spin.push_back(n.spin);
  b.velocity_ahead.push_back(Vec3::Zero());
  b.spin_ahead.push_back(Vec3::Zero());
  b.travel.push_back(0);
  b.force.push_back(Vec3::Zero());
  b.torque.push_back(Vec3::Zero());
  b.motion.push_back(n.fixed ? Motion::fixed : n.airborne ? Motion::airborne : Motion::awake);
}

Vec3 inverse_inertia_times(const Bodies& b, std::size_t i, const Vec3& v) {
  const Vec3& inverse = b.inverse_inertia[i];
  if (inverse.x() == inverse.y())  // symmetric top: no need of the rotation
    return inverse.x() * v + ((inverse.z() - inverse.x()) * v.dot(b.axis[i])) * b.axis[i];
  const Quat& q = b.rotation[i];
  return q * Vec3(inverse.cwiseProduct(q.conjugate() * v));
}

Vec3 spin_of(const Bodies& b, std::size_t i) {
  return inverse_inertia_times(b, i, b.angular_momentum[i]);
}

void kick(Bodies& b, std::size_t i, const Vec3& gravity, double half_step) {
  b.velocity[i] += half_step * (b.inverse_mass[i] * b.force[i] + gravity);
  b.angular_momentum[i] += half_step * b.torque[i];
}

void look_ahead(Bodies& b, std::size_t i, const Vec3& gravity, double half_step) {
  b.velocity_ahead[i] = b.velocity[i] + half_step * (b.inverse_mass[i] * b.force[i] + gravity);
  b.spin_ahead[i] = b.spin[i] + half_step * inverse_inertia_times(b, i, b.torque[i]);
}

void halt(Bodies& b, std::size_t i) {
  b.velocity[i].setZero();
  b.angular_momentum[i].setZero();
  b.spin[i].setZero();
  b.velocity_ahead[i].setZero();
  b.spin_ahead[i].setZero();
}

void drift(Bodies& b, std::size_t i, double step) {
  b.position[i] += step * b.velocity[i];
  const Vec3& inverse = b.inverse_inertia[i];
  if (symmetric(b.inertia[i]))
    turn_symmetric(b.rotation[i], b.angular_momentum[i], b.axis[i], inverse, step);
  else
    turn_asymmetric(b.rotation[i], b.angular_momentum[i], inverse, step);
  renormalise(b.rotation[i]);
  b.axis[i] = b.rotation[i] * Vec3::UnitZ();
  b.spin[i] = spin_of(b, i);
  b.travel[i] += step * (b.velocity[i].norm() + b.spin[i].norm() * b.bounding_radius[i]);
}

void leap(Bodies& b, std::size_t i, const Vec3& gravity, double time) {
  b.position[i] += time * b.velocity[i] + (0.5 * time * time) * gravity;
  b.velocity[i] += time * gravity;
  // the symmetric top leaps exactly; another body in steps that turn it by at most a hundredth
  const double turns =
      symmetric(b.inertia[i]) ? 1.0 : std::ceil(100.0 * b.spin[i].norm() * time / (2.0 * kPi)) + 1.0;
  const Vec3 velocity = b.velocity[i];
  b.velocity[i].setZero();
  for (int k = 0; k < static_cast<int>(turns); ++k) drift(b, i, time / turns);
  b.velocity[i] = velocity;
  b.travel[i] += time * (velocity.norm() + time * gravity.norm());
}

double kinetic_translation(const Bodies& b, std::size_t i) {
  return 0.5 * b.mass[i] * b.velocity[i].squaredNorm();
}

double kinetic_rotation(const Bodies& b, std::size_t i) {
  return 0.5 * b.angular_momentum[i].dot(b.spin[i]);
}

}  // namespace packbed
