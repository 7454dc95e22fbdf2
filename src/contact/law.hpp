#pragma once
// From a Touch to forces: normal spring and dashpot along the gradient of delta, Coulomb friction with a
// tangential spring that remembers, a torsion spring against spinning on the spot, and moments against
// rocking and rolling.
#include "contact/touch.hpp"

namespace packbed {

/// One contact law with its numbers found (see bed/scene.hpp for what a user may give).
struct LawNumbers {
  double stiffness = 0;      // k of the energy k delta^2 / 2 [N/m]
  double damping_ratio = 0;  // zeta [-]
  double friction = 0;       // mu [-]
  bool torsion = false;
  double rolling_friction = 0;  // largest moment against rolling, over the normal force times R* [-]
};

/// Stiffness of the tangential spring over that of the normal one: 2/7 keeps normal and tangential periods of
/// a solid sphere equal (Schaefer, Dippel & Wolf, J. Phys. I France 6, 1996); it is also below the stiffness
/// of the softest edge touch.
inline constexpr double kTangentialShare = 2.0 / 7.0;

/// What a touching pair remembers from step to step. The last three are only for the energy books: what is
/// lost in a step is the mean of the dissipative forces at its ends times the velocity in its middle, as the
/// integrator does work.
struct Spring {
  Vec3 stretch = Vec3::Zero();   // of the tangential spring: displacement of a against b [m]
  double twist = 0;              // turn of a against b about the normal [rad]
  double drag = 0;               // of the dashpot, along the gradient [N]
  Vec3 friction = Vec3::Zero();  // [N]
  double moment = 0;             // of torsion [N m]
  Vec3 rocking = Vec3::Zero();   // moment against rocking and rolling [N m]
};

/// Motion of a against b, as the kernel's Touch sees it.
struct Approach {
  double closing = 0;         // d delta / dt at the end of the step [m/s]
  double closing_mid = 0;     // ... and in its middle
  double inverse_mass = 0;    // of the motion along the gradient: g M^-1 g [1/kg]
  Vec3 slide = Vec3::Zero();  // velocity of a against b at the contact point, mid step [m/s]
  double turn = 0;            // spin of a against b about the normal, mid step [rad/s]
  Vec3 spin = Vec3::Zero();   // of a against b, mid step [rad/s]
  double radius = 0;          // R* = Ra Rb / (Ra + Rb), with a wall Ra: arm of rolling friction [m]
};

struct ContactForce {
  double push = 0;                // multiplies the gradient of Touch: normal force [N]
  Vec3 friction = Vec3::Zero();   // on a, at the contact point [N]
  Vec3 moment = Vec3::Zero();     // on a: torsion, rocking, rolling [N m]
  double elastic = 0;             // energy stored now [J]
  double damped = 0, rubbed = 0;  // energy lost in this step [J]
};

/// Advances the spring by one step and gives the force. Never pulls.
ContactForce resolve(const Touch& touch, const LawNumbers& law, const Approach& approach, double step,
                     Spring& spring);

}  // namespace packbed
