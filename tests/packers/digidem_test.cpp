// The laws that forces between voxels have to keep, within what a voxel allows.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "../shapes.hpp"
#include "math/error.hpp"
#include "math/threads.hpp"
#include "packers/packer.hpp"

namespace packbed {
namespace {

constexpr double kVoxel = 0.2e-3, kGravity = 9.80665;

Scene scene_of(std::vector<PlacedPellet> placed, double friction, double damping) {
  Scene s;
  s.method = "digidem";
  s.pellets = {{test::cylinder(4e-3, 3e-3), 1000, 1}};
  s.container = make_tube("tube", 40e-3, 60e-3);
  s.feed.kind = FeedKind::placed;
  s.feed.placed = std::move(placed);
  s.lattice.voxel = s.analysis.voxel = kVoxel;
  for (ContactLaw* law : {&s.pellet_contact, &s.wall_contact}) {
    law->friction = friction;
    law->damping_ratio = damping;
    law->allowed_overlap = 0.05;
  }
  return s;
}

PlacedPellet at(const Vec3& position, const Vec3& velocity = Vec3::Zero()) {
  PlacedPellet p;
  p.pose.position = position;
  p.velocity = velocity;
  return p;
}

TEST(DigiDem, APelletOnItsFlatEndStandsStillAtItsHeight) {
  Scene s = scene_of({at({0, 0, 3e-3})}, 0.5, 0.4);
  const PackResult r = pack_lattice(s, {});
  EXPECT_TRUE(r.record.at_rest);
  const Pellet& p = r.bed.pellets[0];
  EXPECT_NEAR(p.pose.position.z(), 1.5e-3, 0.5 * kVoxel);
  EXPECT_GT(std::abs((p.pose.rotation * Vec3::UnitZ()).z()), std::cos(2 * kPi / 180));
}

TEST(DigiDem, APelletOnItsEdgeFallsOver) {
  PlacedPellet tilted = at({0, 0, 4e-3});
  tilted.pose.rotation = Quat(Eigen::AngleAxisd(0.35, Vec3::UnitX()));
  const PackResult r = pack_lattice(scene_of({tilted}, 0.5, 0.4), {});
  EXPECT_TRUE(r.record.at_rest);
  EXPECT_NEAR(r.bed.pellets[0].pose.position.z(), 1.5e-3, 0.5 * kVoxel);
}

TEST(DigiDem, RefusesAStepThatItsContactsCannotBear) {
  Scene s = scene_of({at({0, 0, 3e-3})}, 0.5, 0.4);
  s.case_file = "coarse.toml";
  s.stepping.step = 1e-3;
  try {
    pack_lattice(s, {});
    FAIL() << "a step of 1 ms was taken";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("coarse.toml: stepping.step"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("leave the step out"), std::string::npos) << e.what();
  }
}

TEST(DigiDem, TwoPelletsKeepTheirMomentum) {
  Scene s = scene_of({at({-5e-3, 0.3e-3, 30e-3}, {1, 0, 0}), at({5e-3, 0, 30.4e-3}, {-0.5, 0, 0})}, 0.3, 0.2);
  s.gravity = Vec3::Zero();
  s.stepping.duration = 0.012;
  const PackResult r = pack_lattice(s, {});
  const Vec3 sum = r.bed.pellets[0].velocity + r.bed.pellets[1].velocity;
  EXPECT_NEAR((sum - Vec3(0.5, 0, 0)).norm(), 0, 1e-9);
  EXPECT_LT(r.bed.pellets[0].velocity.x(), r.bed.pellets[1].velocity.x());  // they have met and part
}

// Sliding stops after v^2 / (2 mu g).
TEST(DigiDem, SlidingStopsWhereCoulombSays) {
  Scene s = scene_of({at({-10e-3, 0, 1.5e-3 - 0.02e-3}, {0.3, 0, 0})}, 0.3, 0.5);
  s.stepping.duration = 0.3;
  const PackResult r = pack_lattice(s, {});
  const double way = r.bed.pellets[0].pose.position.x() + 10e-3;
  EXPECT_NEAR(way, 0.3 * 0.3 / (2 * 0.3 * kGravity), 0.1 * way);
}

Scene pour() {
  Scene s = scene_of({}, 0.5, 0.4);
  s.container = make_tube("tube", 20e-3, 40e-3);
  s.feed.kind = FeedKind::pour;
  s.feed.count = 40;
  s.feed.per_layer = 6;
  s.feed.drop_height = 30e-3;
  return s;
}

class DigiDemBed : public testing::Test {
 protected:
  void TearDown() override { set_threads(1); }
};

TEST_F(DigiDemBed, ComesToRestAndPassesItsAudit) {
  const PackResult r = pack_lattice(pour(), {});
  for (const AuditLine& line : r.record.audit) EXPECT_TRUE(line.passed) << line.name << ": " << line.finding;
  EXPECT_EQ(r.bed.pellets.size(), 40u);
}

// Between curved walls of five cells a count changes with every little motion. Where its changes come in by
// themselves, with time, these beads still dance at 3 mm/s.
TEST_F(DigiDemBed, BeadsWithThinWallsDoNotDance) {
  Scene s = pour();
  s.pellets = {{make_ring("Hama bead", 4.6e-3, 2.5e-3, 5e-3), 920, 1}};
  s.pellet_contact.friction = s.wall_contact.friction = 0.6;
  s.container = make_tube("tube", 24e-3, 60e-3);
  s.feed.count = 80;
  s.feed.per_layer = 4;
  s.feed.drop_height = 55e-3;
  s.stepping.sleep = false;
  s.stepping.duration = 1.6;  // fed for 0.8
  double square = 0;
  const PackResult r = pack_lattice(s, {});
  for (const Pellet& p : r.bed.pellets) square += p.velocity.squaredNorm() / 80;
  EXPECT_LT(std::sqrt(square), 1e-3);
}

TEST_F(DigiDemBed, IsTheSameForAnyThreadsAndWhenContinued) {
  Scene s = pour();
  s.stepping.duration = 0.25;
  s.output.trajectory_interval = 0.01;
  const std::string whole = bed_hash(pack_lattice(s, {}).bed);
  set_threads(3);
  EXPECT_EQ(bed_hash(pack_lattice(s, {}).bed), whole);
  for (const int shot : {4, 17}) {
    std::atomic<bool> stop{false};
    std::vector<std::byte> state;
    int shots = 0;
    Watch watch;
    watch.stop = &stop;
    watch.snapshot = [&](const Snapshot&) { stop = ++shots >= shot; };
    watch.checkpoint = [&](std::span<const std::byte> bytes) { state.assign(bytes.begin(), bytes.end()); };
    ASSERT_TRUE(pack_lattice(s, watch).stopped);
    EXPECT_EQ(bed_hash(pack_lattice(s, {}, state).bed), whole) << shot;
  }
}

}  // namespace
}  // namespace packbed
