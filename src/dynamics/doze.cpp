#include "dynamics/doze.hpp"

#include <cmath>

namespace packbed {

void begin_watch(Doze& doze, const Bodies& bodies, std::size_t i) {
  doze.anchor = bodies.position[i];
  doze.anchor_rotation = bodies.rotation[i];
}

bool has_stayed(const Doze& doze, const Bodies& bodies, std::size_t i, double size, double limit) {
  if ((bodies.position[i] - doze.anchor).norm() > limit) return false;
  const double turn = 2.0 * (bodies.rotation[i].coeffs() - doze.anchor_rotation.coeffs()).norm();
  return 0.5 * size * turn <= limit;
}

void fall_asleep(Doze& doze, Bodies& bodies, std::size_t i) {
  bodies.motion[i] = Motion::asleep;
  halt(bodies, i);
  doze.force = bodies.force[i];
  doze.torque = bodies.torque[i];
  doze.shift.setZero();
  doze.shift_rate.setZero();
  doze.turn.setZero();
  doze.turn_rate.setZero();
}

double step_shadow(Doze& doze, const Bodies& bodies, std::size_t i, double size, double stiffness,
                   double step) {
  const double omega2 = stiffness * bodies.inverse_mass[i], omega = std::sqrt(omega2);
  const Vec3 push = bodies.inverse_mass[i] * (bodies.force[i] - doze.force);
  const Vec3 twist = inverse_inertia_times(bodies, i, bodies.torque[i] - doze.torque);
  doze.shift_rate += step * (push - omega2 * doze.shift - 2.0 * omega * doze.shift_rate);
  doze.shift += step * doze.shift_rate;
  doze.turn_rate += step * (twist - omega2 * doze.turn - 2.0 * omega * doze.turn_rate);
  doze.turn += step * doze.turn_rate;
  const double per = 1 / omega;
  return doze.shift.norm() + per * doze.shift_rate.norm() +
         0.5 * size * (doze.turn.norm() + per * doze.turn_rate.norm());
}

void wake_from_shadow(Doze& doze, Bodies& bodies, std::size_t i) {
  bodies.motion[i] = Motion::awake;
  begin_watch(doze, bodies, i);
  bodies.velocity[i] = doze.shift_rate;
  bodies.spin[i] = doze.turn_rate;
  const Quat& q = bodies.rotation[i];
  bodies.angular_momentum[i] = q * Vec3(bodies.inertia[i].cwiseProduct(q.conjugate() * doze.turn_rate));
}

}  // namespace packbed
