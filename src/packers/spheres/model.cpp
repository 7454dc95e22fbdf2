#include "packers/spheres/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/law.hpp"
#include "math/error.hpp"
#include "packers/expect.hpp"
#include "packers/packer.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed::spheres {
namespace {

// Sum of the skins of a pair over its mean radius: with less, beds that settle are searched too often, with
// more the lists hold too much that does not touch.
constexpr double kSkin = 0.1;
// Length of a watch, in contact times of light contacts.
constexpr double kWatch = 30;
// Overlap over radius of a contact that carries a few spheres.
constexpr double kLightOverlap = 1e-3;

std::vector<Kind> make_kinds(const Scene& scene) {
  std::vector<Kind> kinds;
  for (const PelletKind& pellet : scene.pellets) {
    if (pellet.shape->kind != ShapeClass::sphere)
      throw InputError(scene.case_file + ": method",
                       "\"spheres\" with a pellet that is a " + std::string(to_string(pellet.shape->kind)),
                       "spheres only", "method = \"mesh\" packs any shape");
    const auto [smallest, largest] = scales_of(scene, static_cast<std::uint32_t>(kinds.size()));
    kinds.push_back({pellet.shape->radius, pellet.density, smallest, largest});
  }
  return kinds;
}

std::vector<SphereWall> make_walls(const Scene& scene) {
  const Container& c = scene.container;
  switch (c.kind) {
    case ContainerKind::none:
      return {};
    case ContainerKind::plane:
      return {{0, 0, 1, 0}};
    case ContainerKind::tube:
      return {{0, 0, 1, 0}, {0, 0, 0, c.radius}};
    case ContainerKind::box:
      return {{0, 0, 1, 0},
              {1, 0, 0, -0.5 * c.width},
              {-1, 0, 0, -0.5 * c.width},
              {0, 1, 0, -0.5 * c.depth},
              {0, -1, 0, -0.5 * c.depth}};
    case ContainerKind::mesh:
      break;  // see SolidWall
  }
  return {};
}

/// Radii and densities of the smallest and the largest sphere that the scene can hold.
struct Extremes {
  double smallest = 0, largest = 0;  // radius [m]
  double density = 0;                // of the lightest kind [kg/m3]
};
Extremes extremes_of(const std::vector<Kind>& kinds) {
  Extremes e{kinds.front().smallest * kinds.front().radius, 0, kinds.front().density};
  for (const Kind& k : kinds) {
    e.smallest = std::min(e.smallest, k.smallest * k.radius);
    e.largest = std::max(e.largest, k.largest * k.radius);
    e.density = std::min(e.density, k.density);
  }
  return e;
}

double mass_of(double radius, double density) {
  return density * 4.0 / 3.0 * kPi * radius * radius * radius;
}

/// Factor of R* in Hooke's stiffness, or of sqrt(R* delta) delta in Hertz's force [Pa], by which the hardest
/// impact on the wall (R* = R) overlaps no size by more than is allowed. As m goes like R^3 and the overlap
/// like R, one modulus serves all sizes.
double modulus_for(const ContactLaw& law, const std::vector<Kind>& kinds, double speed) {
  double modulus = 0;
  for (const Kind& kind : kinds) {
    const double overlap = law.allowed_overlap * 2.0 * kind.radius;
    const double push =
        mass_of(kind.radius, kind.density) * speed * speed / overlap;  // twice the energy over the way
    modulus = std::max(modulus, law.hertz ? 1.25 * push / (std::sqrt(kind.radius * overlap) * overlap)
                                          : push / (kind.radius * overlap));
  }
  return modulus;
}

/// Tangential over normal stiffness of Mindlin: 4 G* / E* of two bodies of one material.
double mindlin_share(const ContactLaw& law) {
  const double nu = law.poisson_ratio, young = law.youngs_modulus;
  const double shear = law.shear_modulus > 0 ? law.shear_modulus : young / (2.0 * (1.0 + nu));
  return 4.0 * (shear / (2.0 * (2.0 - nu))) / (young / (2.0 * (1.0 - nu * nu)));
}

SphereLaw find_law(const Scene& scene, const ContactLaw& law, const std::vector<Kind>& kinds) {
  SphereLaw out;
  out.hertz = law.hertz;
  out.stiffness = law.stiffness;
  if (law.youngs_modulus > 0)
    out.modulus = 4.0 / 3.0 * law.youngs_modulus / (2.0 * (1.0 - law.poisson_ratio * law.poisson_ratio));
  else if (!(law.stiffness > 0))
    out.modulus = modulus_for(law, kinds, hardest_impact(scene));
  out.tangential_share = law.tangential_stiffness > 0 ? law.tangential_stiffness
                         : law.youngs_modulus > 0     ? mindlin_share(law)
                                                      : kTangentialShare;
  out.damping_ratio = law.damping_ratio;
  out.tangential_damping = std::sqrt(out.tangential_share);  // the same damping ratio of its own spring
  out.dissipation = law.dissipation;
  out.tangential_dissipation = law.tangential_dissipation;
  out.friction = law.friction;
  out.rolling_friction = law.rolling_friction;
  return out;
}

/// dF/ddelta at the deepest overlap of the hardest impact [N/m].
double stiffness_of(const SphereLaw& law, double radius, double mass, double speed) {
  const double deepest =
      law.hertz ? std::pow(1.25 * mass * speed * speed / (law.modulus * std::sqrt(radius)), 0.4) : 1.0;
  return elastic_of(law, law.hertz, four(radius), four(deepest)).slope[0];
}

/// Contact time of the stiffest contact: of the smallest sphere.
double shortest_contact(const Model& model, const Extremes& e, double speed) {
  const double mass = mass_of(e.smallest, e.density);
  const double pellets = kPi * std::sqrt(0.5 * mass / model.smallest_stiffness);
  if (model.container.kind == ContainerKind::none) return pellets;
  return std::min(pellets, kPi * std::sqrt(mass / stiffness_of(model.wall_law, e.smallest, mass, speed)));
}

}  // namespace

double swing_of(const Model& model, double radius, double inverse_mass) {
  const SphereLaw& law = model.pellet_law;
  const Four slope = elastic_of(law, law.hertz, four(0.5 * radius), four(kLightOverlap * radius)).slope;
  return std::sqrt(slope[0] * inverse_mass);
}

Model make_model(const Scene& scene) {
  Model model;
  model.kinds = make_kinds(scene);
  model.container = scene.container;
  model.walls = make_walls(scene);
  model.walls.push_back(kNoWall);
  model.gravity = scene.gravity;
  if (scene.gravity.norm() > 0) model.up = -scene.gravity.normalized();
  model.pellet_law = find_law(scene, scene.pellet_contact, model.kinds);
  model.wall_law = find_law(scene, scene.wall_contact, model.kinds);
  model.turns = model.pellet_law.friction > 0 || model.wall_law.friction > 0;
  model.rolls = model.pellet_law.rolling_friction > 0 || model.wall_law.rolling_friction > 0;
  model.stepping = scene.stepping;
  model.gear = scene.stepping.gear;
  const Extremes e = extremes_of(model.kinds);
  if (scene.container.kind == ContainerKind::mesh) model.solid = std::make_shared<SolidWall>(scene.container);
  const double speed = hardest_impact(scene);
  model.smallest_stiffness =
      stiffness_of(model.pellet_law, 0.5 * e.smallest, 0.5 * mass_of(e.smallest, e.density), speed);
  const double contact = shortest_contact(model, e, speed);
  model.step = step_for(scene, contact, "leave the step out, or make contacts softer");
  model.skin = scene.stepping.skin > 0 ? scene.stepping.skin / e.largest : kSkin / 2;
  model.expected_time = expected_time(scene);
  model.sleeps = scene.stepping.sleep && !model.gear;
  model.swing = swing_of(model, e.smallest, 1.0 / mass_of(e.smallest, e.density));
  model.watch =
      std::max<std::int64_t>(1, std::llround(kWatch * kPi * std::sqrt(0.5) / model.swing / model.step));
  return model;
}

}  // namespace packbed::spheres

namespace packbed {

SphereNumbers sphere_numbers(const Scene& scene) {
  const spheres::Model model = spheres::make_model(scene);
  return {model.step, model.smallest_stiffness};
}

}  // namespace packbed
