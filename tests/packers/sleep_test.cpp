// Sleep must not change what happens (dynamics/doze.hpp).
#include <gtest/gtest.h>

#include "../shapes.hpp"
#include "packers/packer.hpp"

namespace packbed {
namespace {

class Sleep : public testing::TestWithParam<std::string> {
 protected:
  PackResult run(double aside, bool sleep) const {
    Scene s;
    s.method = GetParam();
    const bool spheres = s.method == "spheres";
    s.pellets = {{spheres ? make_sphere("ball", 2e-3) : test::cylinder(4e-3, 3e-3), 1000, 1}};
    s.container = make_tube("tube", 40e-3, 60e-3);
    s.lattice.voxel = s.analysis.voxel = 0.2e-3;
    for (ContactLaw* law : {&s.pellet_contact, &s.wall_contact}) {
      law->friction = law->damping_ratio = 0.4;
      law->stiffness = 5e3;
      if (spheres) law->rolling_friction = 0.1;
    }
    PlacedPellet lies, comes;
    lies.pose.position = {0, 0, spheres ? 2.01e-3 : 1.55e-3};
    comes.pose.position = {-17e-3, aside, 13e-3};
    comes.velocity = {0.3, 0, 0};
    s.feed.kind = FeedKind::placed;
    s.feed.placed = {lies, comes};
    s.stepping.sleep = sleep;
    return pack(s, {});
  }
};

// One lies on the floor and has fallen asleep when the other runs into its side: it is pushed as far as if it
// had been awake. Where a hit lands on voxels matters for each, so the mean of several. A sleeper that stood
// like a wall until its shadow had gone its way, and then began at rest, went half as far.
TEST_P(Sleep, WhatIsHitIsPushedAsFarAsIfAwake) {
  double slept = 0, awake = 0;
  for (int k = 0; k < 12; ++k) {
    const double aside = (k - 5.5) * 0.07e-3;
    const PackResult with = run(aside, true), without = run(aside, false);
    EXPECT_GE(with.record.counters.at("wakes"), 1);
    EXPECT_EQ(without.record.counters.at("wakes"), 0);
    EXPECT_TRUE(with.record.at_rest && without.record.at_rest);
    slept += with.bed.pellets[0].pose.position.x() / 12;
    awake += without.bed.pellets[0].pose.position.x() / 12;
  }
  EXPECT_GT(awake, 1e-3);
  EXPECT_NEAR(slept, awake, 0.08 * awake);
}

// A small sphere sleeps on a large one, which is then knocked away. Its weight is too little for its shadow
// to tell: it is woken now and then, and falls.
TEST(LightSleep, FallsWhenWhatItLiesOnHasGone) {
  Scene s;
  s.method = "spheres";
  s.pellets = {{make_sphere("small", 0.265e-3), 1000, 0.5}, {make_sphere("large", 5e-3), 1000, 0.5}};
  s.container.kind = ContainerKind::plane;
  s.container.name = "floor";
  for (ContactLaw* law : {&s.pellet_contact, &s.wall_contact}) {
    law->friction = law->damping_ratio = 0.3;
    law->stiffness = 100;
  }
  const auto place = [&](const Vec3& at, std::uint32_t kind) -> PlacedPellet& {
    PlacedPellet& p = s.feed.placed.emplace_back();
    p.pose.position = at;
    p.kind = kind;
    return p;
  };
  place({0, 0, 10.266e-3}, 0);
  place({0, 0, 5e-3}, 1);
  place({-40e-3, 0, 5e-3}, 1).velocity = {0.2, 0, 0};
  s.feed.kind = FeedKind::placed;
  s.stepping.duration = 0.8;
  const PackResult result = pack(s, {});
  EXPECT_GT(result.bed.pellets[1].pose.position.x(), 10e-3);
  EXPECT_LT(result.bed.pellets[0].pose.position.z(), 0.3e-3);
  EXPECT_GE(result.record.counters.at("sleeps"), 1);
  s.stepping.duration = 0.1;  // asleep and still there, though the large one is about to be hit
  EXPECT_GT(pack(s, {}).bed.pellets[0].pose.position.z(), 10e-3);
}

INSTANTIATE_TEST_SUITE_P(Methods, Sleep, testing::Values("mesh", "digidem", "spheres"),
                         [](const auto& p) { return p.param; });

}  // namespace
}  // namespace packbed
