#pragma once
// The law between spheres, four contacts at a time.
//
//   normal       F = k delta (Hooke) or (4/3) E* sqrt(R* delta) delta (Hertz), and a dashpot; never pulls
//   tangential   a spring that remembers, a dashpot, and Coulomb's limit; its stiffness is a share of
//   dF/ddelta rolling      a spring against rolling, limited by rolling_friction R* F (Ai et al., Powder
//   Technol. 206, 2011)
//
// Both dashpots are sums of two forms: 2 zeta sqrt(S m*) with S = dF/ddelta, which keeps the restitution
// whatever the speed (for Hertz with the factor sqrt(5/6) of Antypov & Elliott, EPL 94, 2011), and gamma m*
// (Dziugys & Peters, Granular Matter 3, 2001).
//
// The spring's history is kept in step with the positions: velocities are those of the middle of the step,
// and so are the normals that they are projected with. With the normal of the end of the step a part of the
// approach would be taken for sliding (Vyas et al., Comput. Phys. Commun. 310, 2025).
#include <cmath>

#include "math/lanes.hpp"

namespace packbed {

struct SphereLaw {
  bool hertz = false;
  double stiffness = 0;               // Hooke: k is this ... [N/m]
  double modulus = 0;                 // ... plus this times R* [Pa]; Hertz: (4/3) E* [Pa]
  double damping_ratio = 0;           // zeta [-]
  double tangential_damping = 0;      // tangential dashpot over the normal one, of the first form [-]
  double dissipation = 0;             // gamma of the normal dashpot [1/s]
  double tangential_dissipation = 0;  // ... of the tangential one [1/s]
  double tangential_share = 0;        // tangential stiffness over dF/ddelta [-]
  double friction = 0;                // [-]
  double rolling_friction = 0;        // [-]
};

/// What a law has, known when the loops are compiled: what it has not costs nothing.
template <bool Hertz, bool Friction, bool Rolling>
struct SphereForm {
  static constexpr bool hertz = Hertz, friction = Friction, rolling = Rolling;
};

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

/// A spring that four contacts remember: its stretch and the stiffness that it had; half their product with
/// the stretch is the energy in it. In memory one Quad a contact, w the stiffness.
struct Springs {
  FourVec stretch;
  Four stiffness{};
};

/// Four contacts of a against b.
struct SphereTouch {
  FourFlags touches{};         // the others count for nothing
  FourVec normal, normal_mid;  // unit, from b to a: at the end and in the middle of the step
  Four delta{};                // overlap [m]
  Four radius{}, mass{};       // R* = Ra Rb / (Ra + Rb) [m], m* [kg]
  Four thickness{};            // of the smaller one, what depths are measured by [m]
  FourVec mid;                 // velocity of the centre of a against that of b, mid step [m/s]
  FourVec turning;             // sum of arm times spin of both, mid step [m/s]
  FourVec rolling;             // spin of a against b, mid step [rad/s]
};

/// What the contacts have lost, and how deep they were; sums of four lanes each. Aligned by hand: without
/// wide vectors the compiler would ask for half as much, and code for wide ones reads it too.
struct alignas(32) SphereTally {
  Four damped{}, rubbed{};              // [J]
  Four deepest{};                       // fraction of the thickness
  Four touches{}, deep{}, very_deep{};  // evaluations that touch, deeper than 5 % and 10 %
};

struct SphereForce {
  FourVec force;    // on a [N]
  FourVec moment;   // normal x force [N]: the torque on a is -arm_a times it, on b -arm_b times it
  FourVec rolling;  // moment against rolling: on a, and minus it on b [N m]
};

/// dF/ddelta and F.
struct SphereElastic {
  Four slope, force;
};
PACKBED_INLINE SphereElastic elastic_of(const SphereLaw& law, bool hertz, const Four& radius,
                                        const Four& delta) {
  if (!hertz) {
    const Four k = law.stiffness + law.modulus * radius;
    return {k, k * delta};
  }
  const Four s = law.modulus * root(radius * delta);
  return {1.5 * s, s * delta};
}
/// Energy of the normal spring over F delta.
inline double elastic_share(const SphereLaw& law) {
  return law.hertz ? 0.4 : 0.5;
}

/// Energy in a spring [J].
PACKBED_INLINE Four stored_in(const Springs& s) {
  return 0.5 * s.stiffness * dot(s.stretch, s.stretch);
}

/// One step of a spring that turns with the normal, with a dashpot beside it, under Coulomb's limit: gives
/// the force that it exerts and adds what was lost. The stretch grows with `rate`, which is in the tangent
/// plane of the middle of the step.
PACKBED_INLINE FourVec stretch_on(const SphereTouch& t, double step, const FourVec& rate,
                                  const Four& stiffness, const Four& dashpot, const Four& limit, Springs& s,
                                  SphereTally& tally) {
  const Four none{};
  // mirrored twice, at the middle normal and (below) at the end's, the stretch has turned with the normal and
  // kept its length
  const FourVec before = s.stretch - (2.0 * dot(s.stretch, t.normal_mid)) * t.normal_mid;
  FourVec now = before + step * rate;
  now = now - dot(now, t.normal) * t.normal;
  FourVec force = FourVec{} - (stiffness * now + dashpot * rate);
  const Four size2 = dot(force, force);
  const FourFlags slips = t.touches & (size2 > limit * limit);
  if (any(slips)) {
    force = (slips ? limit / root(slips ? size2 : four(1.0)) : four(1.0)) * force;
    now = choose(slips, (-1.0 / (slips ? stiffness : four(1.0))) * force, now);
  }
  const Four lost_before = stored_in(s);  // if it has come apart
  // what was put in, by the mean of the forces at both ends, less what the spring has gained
  Four lost = 0.5 * (s.stiffness - stiffness) * dot(before, now);
  if (any(slips)) {  // the spring has not gone along with the surfaces
    const FourVec mean = 0.5 * (s.stiffness * before + stiffness * now);
    lost = slips ? step * dot(mean, rate) + lost_before - 0.5 * stiffness * dot(now, now) : lost;
  }
  s.stretch = choose(t.touches, now, FourVec{});
  s.stiffness = t.touches ? stiffness : none;
  tally.rubbed += t.touches ? lost : lost_before;
  tally.damped += (t.touches & ~slips) ? step * dashpot * dot(rate, rate) : none;
  return choose(t.touches, force, FourVec{});
}

/// What the contacts remember from step to step.
struct SphereState {
  FourFlags touched{};  // at the end of the last step; else nothing but the springs counts
  Four drag{};          // force of the dashpot then [N]
  Four closing{};       // speed of approach in its middle [m/s]
  Springs slip, roll;
};

/// Advances the springs by one step and gives the forces; zero where nothing touches.
template <class Form>
PACKBED_INLINE SphereForce resolve(Form, const SphereLaw& law, const SphereTouch& t, double step,
                                   SphereState& state, SphereTally& tally) {
  const Four none{};
  const Four delta = t.touches ? t.delta : none;
  const SphereElastic e = elastic_of(law, Form::hertz, t.radius, delta);
  Four dashpot = none;
  if (law.damping_ratio > 0) {
    const double zeta = law.damping_ratio * (Form::hertz ? 0.91287092917527686 : 1.0);  // sqrt(5/6)
    dashpot = 2.0 * zeta * root(e.slope * t.mass);
  }
  const Four tangential_dashpot = law.tangential_damping * dashpot + law.tangential_dissipation * t.mass;
  dashpot += law.dissipation * t.mass;
  // at the end of the step, by the acceleration of the last one
  const Four closing = -dot(t.mid, t.normal);
  const Four at_end = state.touched ? 1.5 * closing - 0.5 * state.closing : closing;
  const Four push = t.touches ? larger(none, e.force + dashpot * at_end) : none;
  // the mean of the dashpot's force at both ends of the step, along the way that the integrator goes between
  const Four drag_before = state.touched ? state.drag : none;
  state.drag = t.touches ? push - e.force : none;
  tally.damped += t.touches ? (0.5 * step) * (state.drag + drag_before) * closing : none;
  const FourFlags parts = ~t.touches & (drag_before < 0.0);
  if (any(parts)) {  // held back until the end, the spring has given its energy to the dashpot
    const Four last = parts ? larger(none, t.delta - step * closing) : none;
    const Four force = elastic_of(law, Form::hertz, t.radius, last).force;
    tally.damped += parts ? smaller(force, -drag_before) * elastic_share(law) * last : none;
  }
  state.closing = closing;
  state.touched = t.touches;

  SphereForce out;
  out.force = push * t.normal;
  if constexpr (Form::friction) {
    FourVec slide = t.mid - cross(t.turning, t.normal_mid);
    slide = slide - dot(slide, t.normal_mid) * t.normal_mid;
    const Four stiffness = law.tangential_share * e.slope;
    const FourVec friction =
        stretch_on(t, step, slide, stiffness, tangential_dashpot, law.friction * push, state.slip, tally);
    out.force = out.force + friction;
    out.moment = cross(t.normal, friction);
    if constexpr (Form::rolling) {
      const FourVec rate = t.rolling - dot(t.rolling, t.normal_mid) * t.normal_mid;
      const Four arm2 = t.radius * t.radius;
      out.rolling = stretch_on(t, step, rate, stiffness * arm2, tangential_dashpot * arm2,
                               law.rolling_friction * t.radius * push, state.roll, tally);
    }
  }
  tally.touches += t.touches ? four(1.0) : none;
  if (any(delta > smaller(tally.deepest, four(0.05)) * t.thickness)) {
    tally.deepest = larger(tally.deepest, delta / t.thickness);
    tally.deep += delta > 0.05 * t.thickness ? four(1.0) : none;
    tally.very_deep += delta > 0.1 * t.thickness ? four(1.0) : none;
  }
  return out;
}

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
}  // namespace packbed
