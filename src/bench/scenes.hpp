#pragma once
// Scenes built in code, and runs of them that keep what they saw.
#include <vector>

#include "packers/packer.hpp"

namespace packbed::bench {

inline constexpr double kGravity = 9.80665;  // [m/s2]
inline constexpr double kDensity = 2410;     // of the A38 pellet [kg/m3]

/// Free space or a floor, one kind of pellet, placed; no gravity, loss, friction or sleep. Contacts of 10
/// kN/m: an A38 touches for 0.28 ms.
Scene plain_scene(ContainerKind container, const ShapePtr& shape);
void set_contact(Scene& scene, double friction, double damping_ratio);
PlacedPellet& place(Scene& scene, const Vec3& position, const Quat& rotation = Quat::Identity());

struct Energies : PelletEnergy {
  double sum() const { return translation + rotation + height; }
};

struct Frame {
  double time = 0;  // [s]
  std::vector<Pellet> pellets;
  std::vector<Energies> energies;
  double elastic = 0;  // [J]
};

struct Course {
  PackResult result;
  std::vector<Frame> frames;  // the first at time 0, the last at the end
};

/// Runs for exactly `duration` [s] and keeps a frame every `interval` [s].
Course run_scene(Scene scene, double duration, double interval);

}  // namespace packbed::bench
