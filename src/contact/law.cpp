#include "contact/law.hpp"

namespace packbed {
namespace {

// Of the dashpot that acts against rocking. All of it would hold a toppling cylinder back by its rim; a third
// still ends the rocking of a flat touch within a few periods.
constexpr double kRockingShare = 0.3;
// Rolling friction is a dashpot below its limit: as if the touch were this wide, fraction of R*. An A38 that
// rolls slower than some millimetres a second stops within some hundredths of a second.
constexpr double kRollingWidth = 0.1;

Vec3 at_most(const Vec3& moment, double limit) {
  const double size2 = moment.squaredNorm();
  return size2 > limit * limit ? Vec3(moment * (limit / std::sqrt(size2))) : moment;
}

/// Keeps the stretch in the tangent plane as the normal turns, without changing its length.
void follow_normal(Vec3& stretch, const Vec3& normal) {
  const double before = stretch.squaredNorm();
  stretch -= stretch.dot(normal) * normal;
  const double after = stretch.squaredNorm();
  if (after > 0) stretch *= std::sqrt(before / after);
}

/// c: of the tangential dashpot [N s/m].
void add_friction(ContactForce& out, const LawNumbers& law, const Approach& approach, double c, double step,
                  const Vec3& normal, double normal_force, Spring& spring) {
  const double k = kTangentialShare * law.stiffness;
  const Vec3 slide = approach.slide - approach.slide.dot(normal) * normal;
  follow_normal(spring.stretch, normal);
  const double stored_before = 0.5 * k * spring.stretch.squaredNorm();
  spring.stretch += step * slide;
  Vec3 force = -k * spring.stretch - c * slide;
  const double limit = law.friction * normal_force;
  if (force.squaredNorm() > limit * limit) {
    force *= limit / force.norm();
    spring.stretch = -force / k;
  }
  const double stored = 0.5 * k * spring.stretch.squaredNorm();
  out.friction = force;
  out.elastic += stored;
  out.rubbed -= 0.5 * step * (force + spring.friction).dot(slide) + (stored - stored_before);
  spring.friction = force;
}

/// c: of the tangential dashpot [N s/m].
void add_torsion(ContactForce& out, const Touch& touch, const LawNumbers& law, const Approach& approach,
                 double c, double step, const Vec3& normal, double normal_force, Spring& spring) {
  const double r2 = touch.patch_radius * touch.patch_radius;
  const double k = kTangentialShare * law.stiffness * r2;
  if (!(k > 0)) return;
  const double stored_before = 0.5 * k * spring.twist * spring.twist;
  spring.twist += step * approach.turn;
  double moment = -k * spring.twist - c * r2 * approach.turn;
  const double limit = law.friction * normal_force * touch.patch_radius;  // pressure on a ring of that radius
  if (std::abs(moment) > limit) {
    moment = moment > 0 ? limit : -limit;
    spring.twist = -moment / k;
  }
  const double stored = 0.5 * k * spring.twist * spring.twist;
  out.moment += moment * normal;
  out.elastic += stored;
  out.rubbed -= 0.5 * step * (moment + spring.moment) * approach.turn + (stored - stored_before);
  spring.moment = moment;
}

/// The dashpot is spread over the patch as the pressure is: points of it that approach while others part
/// brake rocking, which the mean approach does not see. A line touch brakes only the rocking along it; what
/// rolls over it is braked by rolling friction.
void add_rocking(ContactForce& out, const Touch& touch, const LawNumbers& law, const Approach& approach,
                 double damping, double step, const Vec3& normal, double normal_force, Spring& spring) {
  const Vec3 over = approach.spin.cross(normal);
  Vec3 moment =
      at_most(-kRockingShare * damping * normal.cross(touch.patch * over), normal_force * touch.patch_radius);
  if (law.rolling_friction > 0) {
    const double width = kRollingWidth * approach.radius;
    moment += at_most(-damping * width * width * normal.cross(over),
                      law.rolling_friction * approach.radius * normal_force);
  }
  out.moment += moment;
  out.damped -= 0.5 * step * (moment + spring.rocking).dot(approach.spin);
  spring.rocking = moment;
}

}  // namespace

ContactForce resolve(const Touch& touch, const LawNumbers& law, const Approach& approach, double step,
                     Spring& spring) {
  ContactForce out;
  const double stiffness = law.stiffness * touch.share;
  const double damping = approach.inverse_mass > 0
                             ? 2.0 * law.damping_ratio * std::sqrt(stiffness / approach.inverse_mass)
                             : 0.0;
  const double spring_force = stiffness * touch.delta;
  out.push = std::max(0.0, spring_force + damping * approach.closing);
  out.elastic = 0.5 * spring_force * touch.delta;
  const double drag = out.push - spring_force;
  out.damped = 0.5 * (drag + spring.drag) * approach.closing_mid * step;
  spring.drag = drag;
  const double length = touch.gradient.norm();
  if (!(length > 0)) return out;
  const Vec3 normal = touch.gradient / length;
  const double normal_force = out.push * length;
  if (damping > 0)
    add_rocking(out, touch, law, approach, damping * length * length, step, normal, normal_force, spring);
  if (!(law.friction > 0)) return out;
  // critical damping goes with the root of the stiffness
  const double tangential = damping * std::sqrt(kTangentialShare);
  add_friction(out, law, approach, tangential, step, normal, normal_force, spring);
  if (law.torsion) add_torsion(out, touch, law, approach, tangential, step, normal, normal_force, spring);
  return out;
}

}  // namespace packbed
