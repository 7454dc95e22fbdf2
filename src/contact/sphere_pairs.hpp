#pragma once
// Forces between spheres, and between spheres and walls, from lists of pairs. Pairs come eight to a block,
// and what they remember is kept component by component, so that a block is loaded as it stands. Memory is
// advanced in place and forces are added to the spheres in the order of the list. All eight are computed
// side by side where the processor has AVX-512, otherwise four and four; the bytes are the same.
#include <array>
#include <cstdint>
#include <span>

#include "contact/sphere_law.hpp"

namespace packbed {

/// What the loops read and write, a Quad a sphere.
struct SphereView {
  const Quad* place = nullptr;     // centre [m], radius [m]
  const Quad* velocity = nullptr;  // mid step [m/s], inverse mass [1/kg] (0: fixed)
  const Quad* spin = nullptr;      // mid step [rad/s]
  Quad* force = nullptr;           // [N]; entries beyond the spheres may serve as slots
  Quad* twist = nullptr;           // torque over minus the radius [N]
};

/// Eight pairs. A lane of no use has b = a (or the wall kNoWall): it never touches.
struct alignas(32) PairBlock {
  LaneNumbers a{}, b{};  // spheres; b: or number of the wall
  LaneNumbers to{};      // where b's share goes: b, or a slot that is summed later
};

/// Of eight pairs, see Springs.
struct SpringBlock {
  std::array<LaneRow, 3> stretch;
  LaneRow stiffness;
};
/// Of eight pairs: force of the dashpot at the end of the last step [N], and the speed at which they
/// approached in its middle [m/s]; kApart when they did not touch.
struct DashBlock {
  static constexpr double kApart = 1e300;
  LaneRow drag, closing{{kApart, kApart, kApart, kApart, kApart, kApart, kApart, kApart}};
};
/// What contacts remember, an entry a block.
struct SphereMemory {
  SpringBlock* slip = nullptr;  // null without friction
  SpringBlock* roll = nullptr;  // null without rolling friction
  DashBlock* dash = nullptr;
};

/// SphereSums in memory.
struct SphereTally {
  LaneRow damped, rubbed;  // [J]
  LaneRow deepest;         // fraction of the thickness
  LaneRow touches, deep;   // evaluations that touch, deeper than 5 %
};

/// A flat wall: the points x with normal . x > offset are free. A round one: normal zero, and the points
/// nearer to the z axis than offset are free.
using SphereWall = Quad;
inline constexpr SphereWall kNoWall{0, 0, 1, -1e300};

/// What one contact is like, for lists of contacts.
struct SphereContact {
  Quad force;          // on a [N]; w: overlap [m]
  double elastic = 0;  // stored in all its springs [J]
};

/// What a loop walks over.
struct SphereWork {
  const SphereLaw& law;
  SphereView view;
  double step = 0;  // [s]
  std::span<const PairBlock> blocks;
  SphereMemory memory;
  SphereTally& tally;
  // when given, it gets an entry a lane, from velocities of the end of the step, and nothing else is written
  SphereContact* contacts = nullptr;
};

/// The loops over lists, compiled for one width.
struct SphereLoops {
  const char* name;
  void (*touch_spheres)(const SphereWork& work);
  void (*touch_walls)(const SphereWork& work, std::span<const SphereWall> walls);
  /// Walls of any form: `sides` has the unit normal and the distance [m] of the wall beside the sphere of
  /// each lane.
  void (*touch_given_walls)(const SphereWork& work, std::span<const Quad> sides);
};

/// Those that this machine can run, the fastest last.
std::span<const SphereLoops> sphere_loops();
inline const SphereLoops& fastest_sphere_loops() {
  return sphere_loops().back();
}

}  // namespace packbed
