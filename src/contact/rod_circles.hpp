#pragma once
// Where the circles of two cylinders dip into one another, looked for afresh.
#include <array>
#include <cstdint>

#include "contact/rod.hpp"
#include "contact/rod_arcs.hpp"

namespace packbed {

/// Circles of a pair: rims, rings in the caps and rings round the sides; those of the first body come first.
inline constexpr std::uint8_t kRodCircles = 20;
inline bool of_a(std::uint8_t circle) {
  return circle < kRodCircles / 2;
}

/// A circle of one cylinder, which may dip into another.
struct RodCircle {
  Vec3 centre;
  double radius;
  const Rod *owner, *other;
};
RodCircle circle_of(std::uint8_t circle, const Rod& a, const Rod& b);

/// The plane of the circles of one body, seen from the other: the same for all of them.
struct RodPlane {
  Vec3 e1, e2;
  double sine = 0;    // between the axes
  double turned = 0;  // angle from the vector that looks share to e1

  RodPlane(const Vec3& axis, const Vec3& other, const Vec3& wish);
};

/// What a look at one circle finds.
struct ArcsFound {
  std::array<RodArc, 8> arc;  // angles from e1 of the plane
  std::size_t size = 0;
  double gap = 1e30;  // way to go before it can touch where it does not [m]

  void add(const RodArc& a) {
    if (size < arc.size()) arc[size++] = a;
  }
};

/// Looks at one circle: the arcs that dip in, and how far the rest of it is from that.
ArcsFound find_arcs(std::uint8_t circle, const RodCircle& f, const RodPlane& plane);

}  // namespace packbed
