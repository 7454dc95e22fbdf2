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

class WithThreads : public testing::Test {
 protected:
  void TearDown() override { set_threads(1); }
};

using SameBed = WithThreads;

TEST_F(SameBed, ForOneTwoAndFourThreads) {
  std::vector<std::string> hashes;
  for (const int count : {1, 2, 4}) {
    set_threads(count);
    hashes.push_back(bed_hash(pack_mesh(pour(), {}).bed));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST_F(SameBed, OnlyForTheSameSeed) {
  Scene other = pour();
  other.seed = 2;
  EXPECT_NE(bed_hash(pack_mesh(pour(), {}).bed), bed_hash(pack_mesh(other, {}).bed));
}

/// Stops at the snapshot number `at` and continues from the checkpoint with `count` threads.
PackResult interrupted(int at, int count) {
  std::atomic<bool> stop{false};
  std::vector<std::byte> state;
  int shots = 0;
  Watch watch;
  watch.stop = &stop;
  watch.snapshot = [&](const Snapshot&) { stop = ++shots >= at; };
  watch.checkpoint = [&](std::span<const std::byte> bytes) { state.assign(bytes.begin(), bytes.end()); };
  const PackResult first = pack_mesh(pour(), watch);
  EXPECT_TRUE(first.stopped);
  EXPECT_FALSE(state.empty());
  set_threads(count);
  const PackResult second = pack_mesh(pour(), {}, state);
  EXPECT_FALSE(second.stopped);
  set_threads(1);
  return second;
}

TEST_F(SameBed, WhenStoppedAtThreePointsAndContinued) {
  const PackResult whole = pack_mesh(pour(), {});
  for (const int at : {2, 11, 26}) {  // while the first layer falls, while feeding, at the end
    const PackResult continued = interrupted(at, at == 11 ? 2 : 1);
    EXPECT_EQ(bed_hash(continued.bed), bed_hash(whole.bed)) << at;
    EXPECT_EQ(continued.record.time.steps, whole.record.time.steps) << at;
    EXPECT_EQ(continued.record.energy.damped, whole.record.energy.damped) << at;  // the ledger goes on too
  }
}

}  // namespace
}  // namespace packbed
