#pragma once
// Scenes built in code for the tests by law: a few placed pellets, one constant of the law, a trajectory.
#include <cmath>
#include <vector>

#include "packers/packer.hpp"

namespace packbed::law {

inline constexpr double kGravity = 9.80665;  // [m/s2]

// The A38 pellet (seed paper): 3.42 x 3.46 mm, 2.41 g/cm3.
inline constexpr double kDiameter = 3.42e-3, kHeight = 3.46e-3, kDensity = 2410;
inline ShapePtr a38() {
  return make_cylinder("a38", kDiameter, kHeight);
}

/// Free space or a floor, one kind of pellet, nothing lossy, no sleep, no gravity. Contacts of 10 kN/m: an
/// A38 touches for 0.28 ms.
inline Scene scene(ContainerKind container, std::vector<ShapePtr> shapes) {
  Scene s;
  s.name = "law";
  s.container.kind = container;
  s.container.name = "law";
  for (const ShapePtr& shape : shapes)
    s.pellets.push_back({shape, kDensity, 1.0 / static_cast<double>(shapes.size())});
  s.gravity = Vec3::Zero();
  s.pellet_contact.stiffness = s.wall_contact.stiffness = 1e4;
  s.pellet_contact.allowed_overlap = s.wall_contact.allowed_overlap = 0.05;
  s.feed.kind = FeedKind::placed;
  s.stepping.sleep = false;
  s.output.checkpoint_interval = 0;
  return s;
}
inline Scene scene(ContainerKind container, const ShapePtr& shape) {
  return scene(container, std::vector<ShapePtr>{shape});
}

/// Sets friction and damping ratio of all contacts.
inline void set_contact(Scene& s, double friction, double damping_ratio) {
  s.pellet_contact.friction = s.wall_contact.friction = friction;
  s.pellet_contact.damping_ratio = s.wall_contact.damping_ratio = damping_ratio;
}

/// Gravity tilted by `angle` [rad]: downhill is +x.
inline void tilt(Scene& s, double angle) {
  s.gravity = kGravity * Vec3(std::sin(angle), 0, -std::cos(angle));
}

inline PlacedPellet& place(Scene& s, const Vec3& position, const Quat& rotation = Quat::Identity()) {
  PlacedPellet pellet;
  pellet.pose = {position, rotation};
  s.feed.placed.push_back(pellet);
  return s.feed.placed.back();
}

/// Lying on its side, its axis along y.
inline Quat lying() {
  return Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()));
}

struct Frame {
  double time = 0;  // [s]
  std::vector<Pellet> pellets;
  std::vector<PelletEnergy> energies;
  double elastic = 0;
};

struct Course {
  PackResult result;
  std::vector<Frame> frames;  // the first at time 0, the last at `duration` (to one step)
  const Pellet& end(std::size_t i = 0) const { return frames.back().pellets[i]; }
};

/// Runs for exactly `duration` [s] and keeps a frame every `interval` [s] (0: every fiftieth of the
/// duration).
inline Course run(Scene s, double duration, double interval = 0) {
  s.stepping.duration = duration;
  s.output.trajectory_interval = interval > 0 ? interval : duration / 50;
  Course out;
  Watch watch;
  watch.snapshot = [&](const Snapshot& shot) {
    out.frames.push_back({shot.time, *shot.pellets, shot.energies, shot.elastic});
  };
  out.result = pack(s, watch);
  return out;
}

inline double mass(const Scene& s, const Pellet& p) {
  return s.pellets[p.shape].density * s.pellets[p.shape].shape->volume;
}
/// Angular momentum about the pellet's own centre [kg m2/s].
inline Vec3 spin_momentum(const Scene& s, const Pellet& p) {
  const Vec3 inertia = s.pellets[p.shape].density * s.pellets[p.shape].shape->inertia;
  return p.pose.rotation * inertia.cwiseProduct(p.pose.rotation.conjugate() * p.spin);
}
/// Kinetic energy of translation and rotation [J], from velocity and spin alone.
inline double kinetic(const Scene& s, const Pellet& p) {
  return 0.5 * mass(s, p) * p.velocity.squaredNorm() + 0.5 * p.spin.dot(spin_momentum(s, p));
}

/// Restitution of a spring and dashpot that let go when their force ends, damping ratio below 0.7 (Schwager &
/// Pöschel 2007; integrated from m x'' + c x' + k x = 0).
inline double restitution(double zeta) {
  const double s = std::sqrt(1 - zeta * zeta);
  return std::exp(-zeta / s * (kPi - std::atan2(2 * zeta * s, s * s - zeta * zeta)));
}
/// Its inverse, for e above 0.3.
inline double damping(double e) {
  double low = 0, high = 0.5;
  while (high - low > 1e-14) (restitution(0.5 * (low + high)) > e ? low : high) = 0.5 * (low + high);
  return low;
}

}  // namespace packbed::law
