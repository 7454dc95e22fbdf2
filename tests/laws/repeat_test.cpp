// The same scene gives the same bytes: for any number of threads, and stopped and continued.
#include <gtest/gtest.h>

#include <atomic>

#include "laws/law.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

using namespace law;

Scene pour() {
  Scene s = scene(ContainerKind::tube, {a38(), make_sphere("ball", 1.8e-3)});
  s.container = make_tube("tube", 20e-3, 60e-3);
  set_contact(s, 0.5, 0.4);
  s.pellet_contact.stiffness = s.wall_contact.stiffness = 1e3;
  s.gravity = {0, 0, -kGravity};
  s.feed.kind = FeedKind::layers;
  s.feed.count = 60;
  s.feed.per_layer = 12;
  s.feed.drop_height = 30e-3;
  s.feed.interval = 0.04;
  s.stepping.sleep = true;
  s.stepping.duration = 0.3;
  s.output.trajectory_interval = 0.01;
  return s;
}

/// Two kinds of spheres, many enough for several chunks.
Scene sphere_pour() {
  Scene s = pour();
  s.method = "spheres";
  s.pellets = {{make_sphere("small", 1e-3), kDensity, 0.9}, {make_sphere("large", 1.8e-3), kDensity, 0.1}};
  s.pellet_contact.friction = 0.8;
  s.pellet_contact.stiffness = s.wall_contact.stiffness = 200;
  s.feed.count = 700;
  s.feed.kind = FeedKind::pour;
  s.feed.per_layer = 40;
  s.feed.interval = 0.012;
  return s;
}

class SameBed : public testing::TestWithParam<Scene (*)()> {
 protected:
  void TearDown() override { set_threads(1); }
  static PackResult packed() { return pack(GetParam()(), {}); }
};

TEST_P(SameBed, ForOneTwoAndFourThreads) {
  std::vector<std::string> hashes;
  for (const int count : {1, 2, 4}) {
    set_threads(count);
    hashes.push_back(bed_hash(packed().bed));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST_P(SameBed, OnlyForTheSameSeed) {
  Scene other = GetParam()();
  other.seed = 2;
  EXPECT_NE(bed_hash(packed().bed), bed_hash(pack(other, {}).bed));
}

/// Stops at the snapshot number `at` and continues from the checkpoint with `count` threads.
PackResult interrupted(const Scene& scene, int at, int count) {
  std::atomic<bool> stop{false};
  std::vector<std::byte> state;
  int shots = 0;
  Watch watch;
  watch.stop = &stop;
  watch.snapshot = [&](const Snapshot&) { stop = ++shots >= at; };
  watch.checkpoint = [&](std::span<const std::byte> bytes) { state.assign(bytes.begin(), bytes.end()); };
  const PackResult first = pack(scene, watch);
  EXPECT_TRUE(first.stopped);
  EXPECT_FALSE(state.empty());
  set_threads(count);
  const PackResult second = pack(scene, {}, state);
  EXPECT_FALSE(second.stopped);
  set_threads(1);
  return second;
}

TEST_P(SameBed, WhenStoppedAtThreePointsAndContinued) {
  const PackResult whole = packed();
  for (const int at : {2, 11, 26}) {  // while the first layer falls, while feeding, at the end
    const PackResult continued = interrupted(GetParam()(), at, at == 11 ? 2 : 1);
    EXPECT_EQ(bed_hash(continued.bed), bed_hash(whole.bed)) << at;
    EXPECT_EQ(continued.record.time.steps, whole.record.time.steps) << at;
    EXPECT_EQ(continued.record.energy.damped, whole.record.energy.damped) << at;  // the ledger goes on too
  }
}

INSTANTIATE_TEST_SUITE_P(Of, SameBed, testing::Values(&pour, &sphere_pour),
                         [](const auto& of) { return of.index == 0 ? "Meshes" : "Spheres"; });

}  // namespace
}  // namespace packbed
