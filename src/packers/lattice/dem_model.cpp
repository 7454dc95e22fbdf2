// What digidem takes from a scene: the same keys as the mesh packer.
#include <algorithm>
#include <cmath>

#include "packers/expect.hpp"
#include "packers/lattice/dem.hpp"

namespace packbed::lattice {
namespace {

/// As given, or "the hardest impact of one pellet on a wall may overlap by so much".
DemLaw law_of(const Scene& scene, const DemModel& model, const ContactLaw& law) {
  DemLaw out{law.stiffness, law.damping_ratio, law.friction};
  const double speed = hardest_impact(scene);
  if (!(law.stiffness > 0))
    for (std::size_t k = 0; k < model.mass.size(); ++k)
      out.stiffness = std::max(
          out.stiffness,
          largest_scale(scene.pellets[k].sizes) * model.mass[k] *
              std::pow(speed / (law.allowed_overlap * scene.pellets[k].shape->smallest_thickness), 2));
  return out;
}

}  // namespace

DemModel make_dem_model(const Scene& scene) {
  DemModel model;
  model.base = make_model(scene);
  model.gravity = scene.gravity;
  for (const PelletKind& kind : scene.pellets) model.mass.push_back(kind.density * kind.shape->volume);
  model.pellet = law_of(scene, model, scene.pellet_contact);
  model.wall = law_of(scene, model, scene.wall_contact);
  const double lightest = *std::min_element(model.mass.begin(), model.mass.end());
  const double contact =
      kPi * std::sqrt(lightest / std::max(2 * model.pellet.stiffness, model.wall.stiffness));
  model.step = step_for(scene, contact, "leave the step out, or lower contact.stiffness");
  model.watch = std::max<std::int64_t>(1, std::llround(kWatchContacts * contact / model.step));
  model.expected_time = expected_time(scene);
  model.skin = scene.stepping.skin > 0 ? scene.stepping.skin : 0.2 * model.base.largest;
  return model;
}

}  // namespace packbed::lattice
