#pragma once
// Sleep of settled bodies.
//
// Falling asleep: over one watch a body has moved and turned by less than a small fraction of its size.
// Waking: a shadow of the body is integrated instead of the body. The change of the net force since it fell
// asleep drives an oscillator of the period and damping of a contact; how far that is off, with what its
// velocity still adds, is how far the body would go. A short knock from a far impact moves it little, a
// lasting push moves it far. What hangs on after its support has gone moves little in the shadow, whose
// contact is always there: packers ask for it apart.
#include "dynamics/bodies.hpp"

namespace packbed {

/// Length of one watch, in contact times: several periods of a pellet on its contacts.
inline constexpr double kWatchContacts = 60;
/// Contacts that carry less than when the body fell asleep, together by this fraction of its weight, are a
/// lost support.
inline constexpr double kLostSupport = 0.3;

struct Doze {
  Vec3 anchor = Vec3::Zero();  // position when the watch began [m]
  Quat anchor_rotation = Quat::Identity();
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();      // net, when it fell asleep [N], [N m]
  Vec3 shift = Vec3::Zero(), shift_rate = Vec3::Zero();  // how far it would have moved [m], [m/s]
  Vec3 turn = Vec3::Zero(), turn_rate = Vec3::Zero();    // ... and turned [rad], [rad/s]
};

void begin_watch(Doze& doze, const Bodies& bodies, std::size_t i);
/// Whether the body has moved, and its surface at half its `size` turned, by no more than `limit` [m] since
/// the watch began.
bool has_stayed(const Doze& doze, const Bodies& bodies, std::size_t i, double size, double limit);
/// Stops the body and remembers its force and torque.
void fall_asleep(Doze& doze, Bodies& bodies, std::size_t i);
/// One step of the shadow under the body's present force and torque; returns how far it is off and, by its
/// velocity, still going [m].
/// `stiffness`: of a contact [N/m].
double step_shadow(Doze& doze, const Bodies& bodies, std::size_t i, double size, double stiffness,
                   double step);
/// Wakes a body whose shadow has gone too far: it goes on with the shadow's velocity and spin. Without, it
/// would have stood like a wall until then, and what it was hit by so far would be lost.
void wake_from_shadow(Doze& doze, Bodies& bodies, std::size_t i);

}  // namespace packbed
