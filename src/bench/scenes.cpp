#include "bench/scenes.hpp"

namespace packbed::bench {

Scene plain_scene(ContainerKind container, const ShapePtr& shape) {
  Scene s;
  s.name = s.container.name = "bench";
  s.container.kind = container;
  s.pellets.push_back({shape, kDensity, 1.0});
  s.gravity = Vec3::Zero();
  for (ContactLaw* law : {&s.pellet_contact, &s.wall_contact}) {
    law->stiffness = 1e4;
    law->allowed_overlap = 0.05;
  }
  s.feed.kind = FeedKind::placed;
  s.stepping.sleep = false;
  s.output.checkpoint_interval = 0;
  return s;
}

void set_contact(Scene& scene, double friction, double damping_ratio) {
  for (ContactLaw* law : {&scene.pellet_contact, &scene.wall_contact}) {
    law->friction = friction;
    law->damping_ratio = damping_ratio;
  }
}

PlacedPellet& place(Scene& scene, const Vec3& position, const Quat& rotation) {
  PlacedPellet pellet;
  pellet.pose = {position, rotation};
  scene.feed.placed.push_back(pellet);
  return scene.feed.placed.back();
}

Course run_scene(Scene scene, double duration, double interval) {
  scene.stepping.duration = duration;
  scene.output.trajectory_interval = interval;
  Course out;
  Watch watch;
  watch.snapshot = [&](const Snapshot& shot) {
    Frame frame{shot.time, *shot.pellets, {}, shot.elastic};
    for (const PelletEnergy& e : shot.energies) frame.energies.push_back({e});
    out.frames.push_back(std::move(frame));
  };
  out.result = pack(scene, watch);
  return out;
}

}  // namespace packbed::bench
