#pragma once
// Rigid bodies as arrays, and how one moves. What does not change in a run (mass, inertia) stands first.
#include <cstdint>
#include <vector>

#include "math/types.hpp"

namespace packbed {

/// How a body is treated in a step.
enum class Motion : std::uint8_t {
  awake,     // stepped with its contacts
  airborne,  // in free flight, far from everything: leaps from one search to the next in closed form
  asleep,    // settled: stands still, its contacts keep their forces
  fixed      // never moves
};

struct Bodies {
  // set once, when a body enters (n each)
  std::vector<std::uint32_t> kind;      // index of the pellet kind
  std::vector<double> inverse_mass;     // 0 for fixed [1/kg]
  std::vector<double> mass;             // [kg]
  std::vector<Vec3> inertia;            // principal moments, own frame [kg m2]
  std::vector<Vec3> inverse_inertia;    // 0 for fixed
  std::vector<double> bounding_radius;  // [m]
  std::vector<double> scale;            // of the shape [-]
  // written by kick and drift
  std::vector<Vec3> position;                    // centre of mass [m]
  std::vector<Quat> rotation;                    // own frame to world
  std::vector<Vec3> axis;                        // own z in the world
  std::vector<Vec3> velocity;                    // [m/s]
  std::vector<Vec3> angular_momentum;            // about the centre, world axes [kg m2/s]
  std::vector<Vec3> spin;                        // angular velocity, world axes [rad/s]
  std::vector<Vec3> velocity_ahead, spin_ahead;  // at the end of the step, by the last known accelerations
  std::vector<double> travel;                    // bound of the path of any surface point since the start [m]
  // written by gather
  std::vector<Vec3> force, torque;  // [N], [N m], without gravity
  // written by find_pairs, leap and sleep
  std::vector<Motion> motion;

  std::size_t size() const { return mass.size(); }
};

struct NewBody {
  std::uint32_t kind = 0;
  double mass = 0;
  Vec3 inertia = Vec3::Zero();
  double bounding_radius = 0;
  Pose pose;
  Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();
  bool fixed = false;
  bool airborne = false;
  double scale = 1;
};
void add_body(Bodies& bodies, const NewBody& body);

/// World angular velocity of body i from its angular momentum.
Vec3 spin_of(const Bodies& bodies, std::size_t i);
/// I^-1 v in world axes for body i.
Vec3 inverse_inertia_times(const Bodies& bodies, std::size_t i, const Vec3& v);

/// Half a step of velocity and angular momentum under force, torque and gravity.
void kick(Bodies& bodies, std::size_t i, const Vec3& gravity, double half_step);
/// Velocity and spin half a step ahead, for dashpots; zero for what does not move.
void look_ahead(Bodies& bodies, std::size_t i, const Vec3& gravity, double half_step);
/// Stops a body where it is.
void halt(Bodies& bodies, std::size_t i);
/// A step of position and rotation at constant momenta. Rotation: closed form for symmetric tops; else the
/// symmetric splitting of Dullweber, Leimkuhler & McLachlan (J. Chem. Phys. 107, 1997) into turns about the
/// principal axes.
void drift(Bodies& bodies, std::size_t i, double step);
/// Free flight over any time: exact for the centre; rotation as drift.
void leap(Bodies& bodies, std::size_t i, const Vec3& gravity, double time);

double kinetic_translation(const Bodies& bodies, std::size_t i);
double kinetic_rotation(const Bodies& bodies, std::size_t i);

}  // namespace packbed
