#include "packers/expect.hpp"

#include <algorithm>
#include <cmath>

#include "math/error.hpp"
#include "math/quantity.hpp"
#include "packers/feed.hpp"

namespace packbed {

std::pair<double, double> scales_of(const Scene& scene, std::uint32_t kind) {
  if (scene.feed.kind != FeedKind::placed)
    return {smallest_scale(scene.pellets[kind].sizes), largest_scale(scene.pellets[kind].sizes)};
  std::vector<SizeClass> placed;
  for (const PlacedPellet& p : scene.feed.placed)
    if (p.kind == kind) placed.push_back({p.scale, 1, 0});
  return {smallest_scale(placed), largest_scale(placed)};
}

double landing_speed(const Scene& scene) {
  // when all fall together, each component of a velocity is random
  const bool components = enters_at_once(scene.feed.kind);
  double fall = highest_at_entry(scene);
  double speed = components ? std::sqrt(3.0) * scene.feed.speed : scene.feed.speed;
  for (const PlacedPellet& p : scene.feed.placed) {
    const double radius = p.scale * scene.pellets[p.kind].shape->bounding_radius;
    fall = std::max(fall, p.pose.position.z());
    speed = std::max(speed, p.velocity.norm() + radius * p.spin.norm());
  }
  return std::sqrt(speed * speed + 2.0 * scene.gravity.norm() * std::max(0.0, fall));
}

double hardest_impact(const Scene& scene) {
  return std::max(landing_speed(scene), 0.1);
}

double step_for(const Scene& scene, double contact, const std::string& fix) {
  const Stepping& asked = scene.stepping;
  const double step = asked.step > 0 ? asked.step : contact / asked.steps_per_contact;
  // below six steps a contact the explicit scheme gains energy in deep touches (docs/mesh_packer.md)
  if (step > contact / 6.0)
    throw InputError(scene.case_file + ": stepping.step", format_quantity(step, Dimension::time),
                     "at most " + format_quantity(contact / 6.0, Dimension::time, 3) +
                         ", a sixth of the stiffest contact's time",
                     fix);
  return step;
}

double expected_time(const Scene& scene) {
  if (scene.stepping.duration > 0) return scene.stepping.duration;
  const double g = std::max(1e-9, scene.gravity.norm());
  const double fall = std::sqrt(2.0 * std::max(0.0, highest_at_entry(scene)) / g);
  const double layers = enters_at_once(scene.feed.kind)
                            ? 0.0
                            : std::ceil(static_cast<double>(scene.feed.count.value_or(1000)) /
                                        std::max(1, scene.feed.per_layer));
  return layers * scene.feed.interval + fall + 0.3;  // and some time to settle
}

}  // namespace packbed
