#pragma once
// Arcs of circles inside cylinders, eight at a time: where they end, and what they add to a touch.
//
// The sum over an arc is taken at Gauss nodes between its ends. The ends lie where the circle goes through
// the side or through a cap, found by two steps of Newton's method from where they were before; they move
// with the bodies, the nodes with them, and the derivative of both is part of the gradient, which is so exact
// whatever the number of nodes.
#include <array>
#include <cstdint>

#include "contact/rod.hpp"
#include "contact/touch.hpp"

namespace packbed {

/// An arc of circle number `circle` of a pair (see cylinder.cpp), as it was when last looked at.
struct RodArc {
  double from = 0, to = 0;                // [rad], from the first vector of its plane
  std::uint8_t circle = 0;                // 0 .. 19
  std::uint8_t from_cap = 0, to_cap = 0;  // 1: the end lies in a cap; 0: in the side
  std::uint8_t half = 0;  // 1, 2: the first, the second half of a wide arc; 0: the whole of it
  std::uint8_t full = 0;  // a full turn, which has no ends
};

/// Wider arcs are summed in halves [rad]: one rule alone would be off by up to 1e-3 on a whole turn.
inline constexpr double kWideArc = 2.0;

inline constexpr int kLanes = 8;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
struct LaneVec {
  Lanes x{}, y{}, z{};
};

/// What the arcs of a pair add up to, about the origin of the pair (see TouchSum).
enum ArcSum : std::size_t {
  kPower,  // of w d^p [m^(p + 1)]
  kForceX,
  kForceY,
  kForceZ,  // of rate * slope, as it pushes the first body
  kTorqueX,
  kTorqueY,
  kTorqueZ,   // of x cross that
  kPressure,  // of the rate w p d^(p - 1)
  kPressureX,
  kPressureY,
  kPressureZ,  // of rate x
  kXX,
  kYY,
  kZZ,
  kXY,
  kXZ,
  kYZ,  // of rate x x^T
  kArcSums
};

struct RodArcBatch {
  // in, one arc a lane; positions are relative to the centre of the cylinder that the circle dips into
  LaneVec centre, owner, wish, axis;  // of the circle; unit axis of its owner; e1 before it is made
                                      // perpendicular to that; unit axis of the cylinder
  Lanes radius{}, rod_radius{}, half_height{};
  Lanes from{}, to{}, from_cap{}, to_cap{};
  Lanes part{}, span{};  // the part of the arc that is summed: from `part`, fraction `span` of it
  Lanes full{};
  LaneVec origin;  // centre of the cylinder, seen from the origin of the pair
  Lanes sign{};    // 1: a circle of the first body; -1: of the second
  // out; `from` and `to` have moved
  std::array<Lanes, kArcSums> sum{};
  Lanes deepest{};
  Lanes holds{};  // 1: the ends were found where they were looked for; 0: the arc has to be looked for afresh
};

void follow(RodArcBatch& batch);

}  // namespace packbed
