#pragma once
// The linear spring-dashpot that ends when its force does: m x'' + c x' + k x = 0 from x = 0 at speed v until
// the force k x + c x' is no longer repulsive (Schwager & Pöschel, Granular Matter 9, 2007). With m the
// reduced mass at the contact, w0 = sqrt(k / m) and the damping ratio zeta = c / (2 sqrt(k m)), everything
// below depends on zeta only.

namespace packbed {

/// Speed after over speed before a head-on impact; zeta >= 0, any size. 1 at zeta = 0, exp(-2) at zeta = 1.
double restitution_from_damping(double zeta);

/// Its inverse: zeta >= 0 for restitution in (0, 1].
double damping_from_restitution(double restitution);

/// Duration of the impact times w0 [-]; pi at zeta = 0.
double contact_time_factor(double zeta);

/// Largest overlap times w0 / v [-]; 1 at zeta = 0.
double peak_overlap_factor(double zeta);

}  // namespace packbed
