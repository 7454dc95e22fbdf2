#pragma once
// The law between spheres, as many contacts at a time as L has lanes.
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

/// A spring that contacts remember: its stretch and the stiffness that it had; half their product with the
/// stretch is the energy in it.
template <class L>
struct Springs {
  LaneVec<L> stretch;
  L stiffness{};
};

/// Contacts of a against b.
template <class L>
struct SphereTouch {
  Flags<L> touches{};             // the others count for nothing
  LaneVec<L> normal, normal_mid;  // unit, from b to a: at the end and in the middle of the step
  L delta{};                      // overlap [m]
  L radius{}, mass{};             // R* = Ra Rb / (Ra + Rb) [m], m* [kg]
  L thickness{};                  // of the smaller one, what depths are measured by [m]
  LaneVec<L> mid;                 // velocity of the centre of a against that of b, mid step [m/s]
  LaneVec<L> turning;             // sum of arm times spin of both, mid step [m/s]
  LaneVec<L> rolling;             // spin of a against b, mid step [rad/s]
};

/// What the contacts have lost, and how deep they were.
template <class L>
struct SphereSums {
  L damped{}, rubbed{};  // [J]
  L deepest{};           // fraction of the thickness
  L touches{}, deep{};   // evaluations that touch, deeper than 5 %
};

template <class L>
struct SphereForce {
  LaneVec<L> force;    // on a [N]
  LaneVec<L> moment;   // normal x force [N]: the torque on a is -arm_a times it, on b -arm_b times it
  LaneVec<L> rolling;  // moment against rolling: on a, and minus it on b [N m]
};

/// dF/ddelta and F.
template <class L>
struct SphereElastic {
  L slope, force;
};
template <class L>
PACKBED_INLINE SphereElastic<L> elastic_of(const SphereLaw& law, bool hertz, const L& radius,
                                           const L& delta) {
  if (!hertz) {
    const L k = law.stiffness + law.modulus * radius;
    return {k, k * delta};
  }
  const L s = law.modulus * root(radius * delta);
  return {1.5 * s, s * delta};
}
/// Energy of the normal spring over F delta.
PACKBED_INLINE double elastic_share(const SphereLaw& law) {
  return law.hertz ? 0.4 : 0.5;
}

/// Energy in a spring [J].
template <class L>
PACKBED_INLINE L stored_in(const Springs<L>& s) {
  return 0.5 * s.stiffness * dot(s.stretch, s.stretch);
}

/// One step of a spring that turns with the normal, with a dashpot beside it, under Coulomb's limit: gives
/// the force that it exerts and adds what was lost. The stretch grows with `rate`, which is in the tangent
/// plane of the middle of the step.
template <class L>
PACKBED_INLINE LaneVec<L> stretch_on(const SphereTouch<L>& t, double step, const LaneVec<L>& rate,
                                     const L& stiffness, const L& dashpot, const L& limit, Springs<L>& s,
                                     SphereSums<L>& tally) {
  const L none{};
  // mirrored twice, at the middle normal and (below) at the end's, the stretch has turned with the normal and
  // kept its length
  const LaneVec<L> before = s.stretch - (2.0 * dot(s.stretch, t.normal_mid)) * t.normal_mid;
  LaneVec<L> now = before + step * rate;
  now = now - dot(now, t.normal) * t.normal;
  LaneVec<L> force = LaneVec<L>{} - (stiffness * now + dashpot * rate);
  const L size2 = dot(force, force);
  const Flags<L> slips = t.touches & (size2 > limit * limit);
  if (any(slips)) {
    force = (slips ? limit / root(slips ? size2 : all<L>(1.0)) : all<L>(1.0)) * force;
    now = choose(slips, (-1.0 / (slips ? stiffness : all<L>(1.0))) * force, now);
  }
  const L lost_before = stored_in(s);  // if it has come apart
  // what was put in, by the mean of the forces at both ends, less what the spring has gained
  L lost = 0.5 * (s.stiffness - stiffness) * dot(before, now);
  if (any(slips)) {  // the spring has not gone along with the surfaces
    const LaneVec<L> mean = 0.5 * (s.stiffness * before + stiffness * now);
    lost = slips ? step * dot(mean, rate) + lost_before - 0.5 * stiffness * dot(now, now) : lost;
  }
  s.stretch = choose(t.touches, now, LaneVec<L>{});
  s.stiffness = t.touches ? stiffness : none;
  tally.rubbed += t.touches ? lost : lost_before;
  tally.damped += (t.touches & ~slips) ? step * dashpot * dot(rate, rate) : none;
  return choose(t.touches, force, LaneVec<L>{});
}

/// What the contacts remember from step to step.
template <class L>
struct SphereState {
  Flags<L> touched{};  // at the end of the last step; else nothing but the springs counts
  L drag{};            // force of the dashpot then [N]
  L closing{};         // speed of approach in its middle [m/s]
  Springs<L> slip, roll;
};

/// Advances the springs by one step and gives the forces; zero where nothing touches.
template <class Form, class L>
PACKBED_INLINE SphereForce<L> resolve(Form, const SphereLaw& law, const SphereTouch<L>& t, double step,
                                      SphereState<L>& state, SphereSums<L>& tally) {
  const L none{};
  const L delta = t.touches ? t.delta : none;
  const SphereElastic<L> e = elastic_of(law, Form::hertz, t.radius, delta);
  L dashpot = none;
  if (law.damping_ratio > 0) {
    const double zeta = law.damping_ratio * (Form::hertz ? 0.91287092917527686 : 1.0);  // sqrt(5/6)
    dashpot = 2.0 * zeta * root(e.slope * t.mass);
  }
  const L tangential_dashpot = law.tangential_damping * dashpot + law.tangential_dissipation * t.mass;
  dashpot += law.dissipation * t.mass;
  // at the end of the step, by the acceleration of the last one
  const L closing = -dot(t.mid, t.normal);
  const L at_end = state.touched ? 1.5 * closing - 0.5 * state.closing : closing;
  const L push = t.touches ? larger(none, e.force + dashpot * at_end) : none;
  // the mean of the dashpot's force at both ends of the step, along the way that the integrator goes between
  const L drag_before = state.touched ? state.drag : none;
  state.drag = t.touches ? push - e.force : none;
  tally.damped += t.touches ? (0.5 * step) * (state.drag + drag_before) * closing : none;
  const Flags<L> parts = ~t.touches & (drag_before < 0.0);
  if (any(parts)) {  // held back until the end, the spring has given its energy to the dashpot
    const L last = parts ? larger(none, t.delta - step * closing) : none;
    const L force = elastic_of(law, Form::hertz, t.radius, last).force;
    tally.damped += parts ? smaller(force, -drag_before) * elastic_share(law) * last : none;
  }
  state.closing = closing;
  state.touched = t.touches;

  SphereForce<L> out;
  out.force = push * t.normal;
  if constexpr (Form::friction) {
    LaneVec<L> slide = t.mid - cross(t.turning, t.normal_mid);
    slide = slide - dot(slide, t.normal_mid) * t.normal_mid;
    const L stiffness = law.tangential_share * e.slope;
    const LaneVec<L> friction =
        stretch_on(t, step, slide, stiffness, tangential_dashpot, law.friction * push, state.slip, tally);
    out.force = out.force + friction;
    out.moment = cross(t.normal, friction);
    if constexpr (Form::rolling) {
      const LaneVec<L> rate = t.rolling - dot(t.rolling, t.normal_mid) * t.normal_mid;
      const L arm2 = t.radius * t.radius;
      out.rolling = stretch_on(t, step, rate, stiffness * arm2, tangential_dashpot * arm2,
                               law.rolling_friction * t.radius * push, state.roll, tally);
    }
  }
  tally.touches += t.touches ? all<L>(1.0) : none;
  if (const Flags<L> deep = delta > smaller(tally.deepest, all<L>(0.05)) * t.thickness; any(deep)) {
    tally.deepest = deep ? larger(tally.deepest, delta / t.thickness) : tally.deepest;
    tally.deep += delta > 0.05 * t.thickness ? all<L>(1.0) : none;
  }
  return out;
}

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
}  // namespace packbed
