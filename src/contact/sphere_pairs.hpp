#pragma once
// Forces between spheres, and between spheres and walls, from lists of pairs. Pairs come four to a block, and
// what they remember is kept component by component, so that a block is loaded as it stands. Memory is
// advanced in place and forces are added to the spheres in the order of the list.
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

/// Four pairs. A lane of no use has b = a (or the wall kNoWall): it never touches.
struct alignas(16) PairBlock {
  std::array<std::uint32_t, 4> a{}, b{};  // spheres; b: or number of the wall
  std::array<std::uint32_t, 4> to{};      // where b's share goes: b, or a slot that is summed later
};

/// Of four pairs, see Springs.
struct alignas(32) SpringBlock {
  std::array<Quad, 3> stretch;
  Quad stiffness;
};
/// Of four pairs: force of the dashpot at the end of the last step [N], and the speed at which they
/// approached in its middle [m/s]; kApart when they did not touch.
struct alignas(32) DashBlock {
  Quad drag, closing{kApart, kApart, kApart, kApart};
  static constexpr double kApart = 1e300;
};
/// What contacts remember, an entry a block.
struct SphereMemory {
  SpringBlock* slip = nullptr;  // null without friction
  SpringBlock* roll = nullptr;  // null without rolling friction
  DashBlock* dash = nullptr;
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

/// `contacts`, when given, gets four entries a block, from velocities of the end of the step, and nothing
/// else is written.
void touch_spheres(const SphereLaw& law, const SphereView& view, double step,
                   std::span<const PairBlock> blocks, const SphereMemory& memory, SphereTally& tally,
                   SphereContact* contacts = nullptr);
void touch_walls(const SphereLaw& law, const SphereView& view, double step, std::span<const SphereWall> walls,
                 std::span<const PairBlock> blocks, const SphereMemory& memory, SphereTally& tally,
                 SphereContact* contacts = nullptr);
/// Walls of any form: `sides` has the unit normal and the distance [m] of the wall beside the sphere of each
/// lane.
void touch_given_walls(const SphereLaw& law, const SphereView& view, double step, std::span<const Quad> sides,
                       std::span<const PairBlock> blocks, const SphereMemory& memory, SphereTally& tally,
                       SphereContact* contacts = nullptr);

}  // namespace packbed
