#pragma once
// Forces between spheres, and between spheres and walls, from lists of pairs. Springs are advanced in place
// and forces are added to the spheres in the order of the list.
#include <cstdint>
#include <span>

#include "contact/sphere_law.hpp"

namespace packbed {

/// What the loops read and write, a Quad a sphere.
struct SphereView {
  const Quad* place = nullptr;     // centre [m], radius [m]
  const Quad* velocity = nullptr;  // mid step [m/s], inverse mass [1/kg] (0: fixed)
  const Quad* ahead = nullptr;     // velocity at the end of the step by the last known forces [m/s]
  const Quad* spin = nullptr;      // mid step [rad/s]
  Quad* force = nullptr;           // [N]; entries beyond the spheres may serve as slots
  Quad* torque = nullptr;          // [N m]
};

struct SpherePair {
  std::uint32_t a = 0, b = 0;
  std::uint32_t to = 0;  // where b's share of the force goes: b, or a slot that is summed later
};

/// A flat wall: the points x with normal . x > offset are free. A round one: normal zero, and the points
/// nearer to the z axis than offset are free.
using SphereWall = Quad;
struct SphereWallPair {
  std::uint32_t a = 0, wall = 0;
};

/// What one contact is like, for lists of contacts.
struct SphereContact {
  Quad force;          // on a [N]; w: overlap [m]
  double elastic = 0;  // stored in all its springs [J]
};

/// What contacts remember, an entry a pair.
struct SphereMemory {
  Quad* slip = nullptr;    // see FourSprings; null without friction
  Quad* roll = nullptr;    // null without rolling friction
  double* drag = nullptr;  // force of the dashpot at the end of the last step [N]
};

/// `contacts`, when given, gets one entry a pair and nothing else is written.
void touch_spheres(const SphereLaw& law, const SphereView& view, double step,
                   std::span<const SpherePair> pairs, const SphereMemory& memory, SphereTally& tally,
                   SphereContact* contacts = nullptr);
void touch_walls(const SphereLaw& law, const SphereView& view, double step, std::span<const SphereWall> walls,
                 std::span<const SphereWallPair> pairs, const SphereMemory& memory, SphereTally& tally,
                 SphereContact* contacts = nullptr);

/// Walls of any form: `sides` has the unit normal and the distance [m] of the wall beside the sphere of each
/// pair.
void touch_given_walls(const SphereLaw& law, const SphereView& view, double step, std::span<const Quad> sides,
                       std::span<const SphereWallPair> pairs, const SphereMemory& memory, SphereTally& tally,
                       SphereContact* contacts = nullptr);

}  // namespace packbed
