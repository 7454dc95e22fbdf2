#pragma once
// Slow answers that the contact kernels are held against.
#include <optional>

#include "analysis/penetration.hpp"
#include "contact/cylinder.hpp"
#include "contact/touch.hpp"

namespace packbed::bench {

/// The law of contact/cylinder.hpp by brute force: its twenty circles as so many points that force and delta
/// change by less than 1e-5 when there are twice as many, and the crossing of the sides with the slopes of
/// finite differences.
Touch converged_cylinders(const Rod& a, const Rod& b);

/// What the pressure-field law does to a body, in units of its modulus (Elandt, Drumwright, Sherman & Ruina,
/// IROS 2019).
struct PressureTouch {
  Vec3 force = Vec3::Zero();   // on a [m3]
  Vec3 torque = Vec3::Zero();  // on a, about the world's origin [m4]
  Vec3 point = Vec3::Zero();   // centre of pressure [m]
};

/// Of two convex bodies that overlap as `p` says: the integral of the depth over the surface where both
/// depths are equal, on `columns` x `columns` lines along the normal of `p`. Nothing when no line meets it.
std::optional<PressureTouch> pressure_field(const Body& a, const Body& b, const Penetration& p,
                                            int columns = 48);

/// Distance of the line of action of a wrench (torque about the world's origin) from a point [m].
double distance_of_action(const Vec3& force, const Vec3& torque, const Vec3& point);

}  // namespace packbed::bench
