// Shaking: the law of a tap, the work of a vibrating container, and beds that get denser.
#include <gtest/gtest.h>

#include <cmath>

#include "../shapes.hpp"
#include "packers/packer.hpp"
#include "packers/shaking.hpp"

namespace packbed {
namespace {

constexpr double kGravity = 9.80665;

Scene scene_of(const std::string& method) {
  Scene s;
  s.method = method;
  s.pellets = {{test::cylinder(4e-3, 3e-3), 1000, 1}};
  s.container = make_tube("tube", 20e-3, 60e-3);
  s.lattice.voxel = s.analysis.voxel = 0.25e-3;
  s.analysis.from_diameters = 1;
  for (ContactLaw* law : {&s.pellet_contact, &s.wall_contact}) {
    law->friction = 0.4;
    law->damping_ratio = 0.4;
    law->allowed_overlap = 0.05;
  }
  return s;
}

Scene lone(const std::string& method) {
  Scene s = scene_of(method);
  s.feed.kind = FeedKind::placed;
  s.feed.placed = {{}};
  s.feed.placed[0].pose.position = {0, 0, 1.6e-3};
  s.pellet_contact.stiffness = s.wall_contact.stiffness = 5e3;  // for the speeds that shaking gives
  return s;
}

Scene pour(const std::string& method) {
  Scene s = scene_of(method);
  s.feed.kind = FeedKind::pour;
  s.feed.count = 50;
  s.feed.per_layer = 6;
  s.feed.drop_height = 45e-3;
  return s;
}

class Shaken : public testing::TestWithParam<const char*> {};

// A tap of velocity v throws a lone pellet to v^2 / 2g, and every tap does.
TEST_P(Shaken, APelletRisesAsHighAsItsVelocitySays) {
  Scene s = lone(GetParam());
  s.shaking.kind = ShakingKind::taps;
  s.shaking.taps = 2;
  s.shaking.velocity = 0.4;
  s.output.trajectory_interval = 1e-3;
  double top = 0, rest = 0;
  int rises = 0;
  bool up = false;
  Watch watch;
  watch.snapshot = [&](const Snapshot& shot) {
    const double z = shot.pellets->front().pose.position.z();
    top = std::max(top, z);
    if (!up && z > 5e-3) ++rises;
    up = z > 5e-3;
  };
  const PackResult r = pack(s, watch);
  ASSERT_EQ(r.record.taps.size(), 3u);
  rest = r.record.taps[0].top_m;
  EXPECT_NEAR(top - rest, 0.4 * 0.4 / (2 * kGravity), 0.05e-3 + 0.1 * s.lattice.voxel);
  EXPECT_EQ(rises, 2);
}

// Below an acceleration of g nothing leaves the floor, and the container's work comes back.
TEST_P(Shaken, BelowGravityAPelletStaysOnTheFloor) {
  Scene s = lone(GetParam());
  s.shaking.kind = ShakingKind::vibration;
  s.shaking.period = 0.05;
  s.shaking.duration = 0.3;
  s.output.trajectory_interval = 1e-3;
  const auto highest = [&](double of_gravity) {
    const double w = 2 * kPi / s.shaking.period;
    s.shaking.amplitude = of_gravity * kGravity / (w * w);
    double top = 0;
    bool settled = false;
    Watch watch;
    watch.snapshot = [&](const Snapshot& shot) {
      const double z = shot.pellets->front().pose.position.z();
      settled |= shot.time > 0.02;
      if (settled) top = std::max(top, z);
    };
    const PackResult r = pack(s, watch);
    EXPECT_EQ(r.record.taps.size(), 2u);
    for (const AuditLine& line : r.record.audit)
      EXPECT_TRUE(line.passed) << line.name << ": " << line.finding;
    return top;
  };
  EXPECT_LT(highest(0.8), 1.5e-3 + 0.5 * s.lattice.voxel);
  EXPECT_GT(highest(2), 1.5e-3 + 2 * s.lattice.voxel);
}

TEST_P(Shaken, ABedGetsDenserAndIsTheSameWhenContinued) {
  Scene s = pour(GetParam());
  s.shaking.kind = ShakingKind::taps;
  s.shaking.taps = 4;
  const PackResult whole = pack(s, {});
  ASSERT_EQ(whole.record.taps.size(), 5u);
  EXPECT_GT(whole.record.taps.back().packing_density, whole.record.taps.front().packing_density);
  EXPECT_TRUE(whole.record.at_rest);

  s.output.trajectory_interval = 0.05;
  std::atomic<bool> stop{false};
  std::vector<std::byte> state;
  Watch watch;
  watch.stop = &stop;
  watch.snapshot = [&](const Snapshot& shot) { stop = shot.time > whole.record.taps[2].time_s; };
  watch.checkpoint = [&](std::span<const std::byte> bytes) { state.assign(bytes.begin(), bytes.end()); };
  ASSERT_TRUE(pack(s, watch).stopped);
  const PackResult continued = s.method == "mesh" ? pack_mesh(s, {}, state) : pack_lattice(s, {}, state);
  EXPECT_EQ(bed_hash(continued.bed), bed_hash(whole.bed));
  EXPECT_EQ(continued.record.taps.size(), 5u);
}

INSTANTIATE_TEST_SUITE_P(Methods, Shaken, testing::Values("mesh", "digidem"));

}  // namespace
}  // namespace packbed
