#include "packers/spheres/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/law.hpp"
#include "math/error.hpp"
#include "packers/expect.hpp"

namespace packbed::spheres {
namespace {

// Sum of the skins of a pair over its mean radius: with less, beds that settle are searched too often, with
// more the lists hold too much that does not touch.
constexpr double kSkin = 0.1;

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
    case ContainerKind::mesh:
      break;
  }
  throw InputError(scene.case_file + ": container", "a container that was not recognised",
                   "a tube, a plane or free space", "method = \"mesh\" takes any container");
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

SphereLaw find_law(const Scene& scene, const ContactLaw& law, const std::vector<Kind>& kinds) {
  SphereLaw out;
  out.stiffness = law.stiffness;
  if (!(law.stiffness > 0)) {
    // the hardest impact of any sphere on a wall, R* = R, may overlap by so much: as m goes like R^3 and the
    // overlap like R, k goes like R and one modulus serves all sizes
    const double speed =
        std::max(landing_speed(scene), 0.1);  // a bed that is only placed has to carry itself too
    for (const Kind& kind : kinds) {
      const double overlap = law.allowed_overlap * 2.0 * kind.radius;
      out.modulus = std::max(out.modulus, mass_of(kind.radius, kind.density) * speed * speed /
                                              (overlap * overlap * kind.radius));
    }
  }
  out.damping_ratio = law.damping_ratio;
  out.friction = law.friction;
  out.tangential_share = kTangentialShare;
  out.tangential_damping = std::sqrt(kTangentialShare);  // the same damping ratio of its own spring
  return out;
}

/// Contact time of the stiffest contact, by the stiffness at the deepest overlap that is allowed.
double shortest_contact(const Model& model, const Extremes& e) {
  const auto time = [&](const SphereLaw& law, double radius, double mass) {
    const Four slope = elastic_of(law, four(radius), four(0.1 * e.smallest)).slope;
    return kPi * std::sqrt(mass / slope[0]);
  };
  const double mass = mass_of(e.smallest, e.density);
  const double pellets = time(model.pellet_law, 0.5 * e.smallest, 0.5 * mass);
  return model.walls.empty() ? pellets : std::min(pellets, time(model.wall_law, e.smallest, mass));
}

}  // namespace

Model make_model(const Scene& scene) {
  Model model;
  model.kinds = make_kinds(scene);
  model.container = scene.container;
  model.walls = make_walls(scene);
  model.gravity = scene.gravity;
  if (scene.gravity.norm() > 0) model.up = -scene.gravity.normalized();
  model.pellet_law = find_law(scene, scene.pellet_contact, model.kinds);
  model.wall_law = find_law(scene, scene.wall_contact, model.kinds);
  model.turns = model.pellet_law.friction > 0 || model.wall_law.friction > 0;
  model.rolls = model.pellet_law.rolling_friction > 0 || model.wall_law.rolling_friction > 0;
  model.stepping = scene.stepping;
  const Extremes e = extremes_of(model.kinds);
  const double contact = shortest_contact(model, e);
  model.step = scene.stepping.step > 0 ? scene.stepping.step : contact / scene.stepping.steps_per_contact;
  // below six steps a contact the explicit scheme gains energy in deep touches (docs/mesh_packer.md)
  if (model.step > contact / 6.0)
    throw InputError(
        scene.case_file + ": stepping.step", fmt::format("{:.3g} us", 1e6 * model.step),
        fmt::format("at most {:.3g} us, a sixth of the stiffest contact's time", 1e6 * contact / 6.0),
        "leave the step out, or make contacts softer");
  model.skin = scene.stepping.skin > 0 ? scene.stepping.skin / e.largest : kSkin / 2;
  model.expected_time = expected_time(scene);
  return model;
}

}  // namespace packbed::spheres
