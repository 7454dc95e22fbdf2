#include "packers/shaking.hpp"

#include <algorithm>
#include <cmath>

#include "bed/section.hpp"
#include "math/trig.hpp"
#include "packers/account.hpp"

namespace packbed {
namespace {

Vec3 up_of(const Scene& scene) {
  return scene.gravity.norm() > 0 ? Vec3(-scene.gravity.normalized()) : Vec3::UnitZ();
}

TapRecord look_at(const Scene& scene, const ShakeState& state, double time,
                  const std::vector<Pellet>& pellets) {
  TapRecord r{state.taps, time, 0, 0};
  PackedBed bed = bed_of_scene(scene, "");
  bed.pellets = pellets;
  for (const Pellet& p : pellets) r.top_m = std::max(r.top_m, p.pose.position.z());
  const bool sides = bed.container.kind == ContainerKind::tube || bed.container.kind == ContainerKind::mesh;
  r.packing_density = sides ? middle_density(bed, scene.analysis) : std::nan("");
  return r;
}

}  // namespace

std::optional<Vec3> next_shake(const Scene& scene, ShakeState& state, double time,
                               const std::vector<Pellet>& pellets) {
  const Shaking& s = scene.shaking;
  if (s.kind == ShakingKind::none) return {};
  state.found.push_back(look_at(scene, state, time, pellets));
  const int wanted = s.kind == ShakingKind::taps ? s.taps : 1;
  if (state.taps >= wanted) return {};
  ++state.taps;
  if (s.kind == ShakingKind::taps) return Vec3(s.velocity * up_of(scene));
  state.vibrates_from = time;
  state.vibrates_to = time + s.duration;
  return Vec3(Vec3::Zero());
}

Vec3 shaking_acceleration(const Shaking& shaking, const Vec3& up, const ShakeState& state, double time) {
  if (!vibrates(state, time)) return Vec3::Zero();
  // the container is at A sin(w t), so what is in it feels A w^2 sin(w t)
  const double w = 2 * kPi / shaking.period, periods = (time - state.vibrates_from) / shaking.period;
  double sine = 0, cosine = 0;
  sincos_poly(2 * kPi * (periods - std::floor(periods)), sine, cosine);
  return shaking.amplitude * w * w * sine * up;
}

}  // namespace packbed
