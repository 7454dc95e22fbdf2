// Beds on a lattice: nothing overlaps, nothing is lost, the grid is the bed's, and the same scene gives the
// same bytes for any number of threads, stopped and continued.
#include <gtest/gtest.h>

#include <atomic>

#include "../shapes.hpp"
#include "bed/voxelise.hpp"
#include "lattice/occupancy.hpp"
#include "math/error.hpp"
#include "math/threads.hpp"
#include "packers/packer.hpp"

namespace packbed {
namespace {

Scene pour(const std::string& method) {
  Scene s;
  s.method = method;
  s.seed = 3;
  s.pellets = {{test::cylinder(4e-3, 3e-3), 1000, 0.7}, {test::sphere(2e-3), 1000, 0.3}};
  s.container = make_tube("tube", 20e-3, 40e-3);
  s.feed.kind = FeedKind::pour;
  s.feed.count = 60;
  s.feed.per_layer = 6;
  s.feed.drop_height = 35e-3;
  s.lattice.voxel = s.analysis.voxel = 0.25e-3;
  return s;
}

std::string audit_of(const RunRecord& record) {
  std::string failed;
  for (const AuditLine& line : record.audit)
    if (!line.passed) failed += line.name + ": " + line.finding + '\n';
  return failed;
}

class OnTheLattice : public testing::TestWithParam<const char*> {
 protected:
  void TearDown() override { set_threads(1); }
};

TEST_P(OnTheLattice, ABedSettlesWithoutASharedCell) {
  const PackResult result = pack_lattice(pour(GetParam()), {});
  EXPECT_EQ(audit_of(result.record), "");
  EXPECT_EQ(result.bed.pellets.size(), 60u);
  EXPECT_TRUE(result.record.at_rest);
  // the poses say the same: the bed drawn anew has no cell twice, and is the grid that was handed over
  const VoxelGrid drawn = voxelise(result.bed, frame_for(result.bed, 0.25e-3));
  EXPECT_EQ(drawn.doubled, 0);
  ASSERT_EQ(result.grid.frame.size, drawn.frame.size);
  std::size_t differing = 0;
  for (std::size_t w = 0; w < drawn.words.size(); ++w) differing += drawn.words[w] != result.grid.words[w];
  EXPECT_EQ(differing, 0u);
  for (const Pellet& p : result.bed.pellets) {
    EXPECT_LT(p.pose.position.head<2>().norm(), 10e-3);
    EXPECT_GT(p.pose.position.z(), 1.2e-3);
  }
}

TEST_P(OnTheLattice, TheSameBedForOneTwoAndFourThreads) {
  std::vector<std::string> hashes;
  for (const int count : {1, 2, 4}) {
    set_threads(count);
    hashes.push_back(bed_hash(pack_lattice(pour(GetParam()), {}).bed));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
  Scene other = pour(GetParam());
  other.seed = 4;
  EXPECT_NE(bed_hash(pack_lattice(other, {}).bed), hashes[0]);
}

TEST_P(OnTheLattice, TheSameBedWhenStoppedAndContinued) {
  Scene scene = pour(GetParam());
  const PackResult whole = pack_lattice(scene, {});
  scene.output.trajectory_interval = 0.05;
  for (const int at : {3, 8}) {  // while feeding, while settling
    std::atomic<bool> stop{false};
    std::vector<std::byte> state;
    int shots = 0;
    Watch watch;
    watch.stop = &stop;
    watch.snapshot = [&](const Snapshot&) { stop = ++shots >= at; };
    watch.checkpoint = [&](std::span<const std::byte> bytes) { state.assign(bytes.begin(), bytes.end()); };
    ASSERT_TRUE(pack_lattice(scene, watch).stopped);
    set_threads(at == 3 ? 2 : 1);
    const PackResult continued = pack_lattice(scene, {}, state);
    EXPECT_EQ(bed_hash(continued.bed), bed_hash(whole.bed)) << at;
    EXPECT_EQ(continued.record.time.steps, whole.record.time.steps) << at;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, OnTheLattice, testing::Values("digipac", "digicgp"));

// Without gravity's preference (rebound 1) a lone pellet walks up as often as down; with 0 it only falls.
TEST(DigiPac, ReboundSetsHowOftenAPelletRises) {
  Scene s = pour("digipac");
  s.feed.kind = FeedKind::placed;
  s.feed.placed = {{}};
  s.feed.placed[0].pose.position = {0, 0, 30e-3};
  s.lattice.max_steps = 60;
  s.lattice.rest_window = 1000;
  const auto fallen = [&](double rebound) {
    s.lattice.rebound = rebound;
    return (30e-3 - pack_lattice(s, {}).bed.pellets[0].pose.position.z()) / s.lattice.voxel;
  };
  EXPECT_NEAR(fallen(0), 60, 0.51);  // half a cell for the phase of a rotation
  EXPECT_NEAR(fallen(1), 0, 4 * std::sqrt(60.0));
}

// The paper's own rotation: cells are turned. No cell is shared and none is lost, but pellets wear, and a run
// that is continued knows how.
TEST(DigiPac, TurnsCellsAndContinuesWithWornPellets) {
  Scene s = pour("digipac");
  s.lattice.turn_cells = true;
  s.feed.count = 6;
  s.lattice.rotation_share = 0.05;
  const PackResult whole = pack_lattice(s, {});
  EXPECT_EQ(audit_of(whole.record), "");
  EXPECT_NE(whole.record.notes.at(0).find("not where its shape has them"), std::string::npos);
  s.output.trajectory_interval = 0.05;
  std::atomic<bool> stop{false};
  std::vector<std::byte> state;
  Watch watch;
  watch.stop = &stop;
  watch.snapshot = [&](const Snapshot& shot) { stop = shot.time > 0.04; };
  watch.checkpoint = [&](std::span<const std::byte> bytes) { state.assign(bytes.begin(), bytes.end()); };
  ASSERT_TRUE(pack_lattice(s, watch).stopped);
  EXPECT_EQ(bed_hash(pack_lattice(s, {}, state).bed), bed_hash(whole.bed));
}

// Both pellets of a collision feel it: a ball on the floor, which its own collisions only push up, is pushed
// aside by one that comes down beside its top, away from it; and this one rolls off to the other side.
TEST(DigiCgp, APelletIsPushedAsideByTheOneThatLandsOnIt) {
  Scene s = pour("digicgp");
  s.pellets = {{test::sphere(2e-3), 1000, 1}};
  s.container = make_tube("tube", 40e-3, 40e-3);
  s.feed.kind = FeedKind::placed;
  s.feed.placed = {{}, {}};
  s.feed.placed[0].pose.position = {0, 0, 2.02e-3};
  s.feed.placed[1].pose.position = {1e-3, 0, 6.5e-3};
  s.lattice.max_steps = 60;
  s.lattice.rest_window = 1000;
  const std::vector<Pellet> pellets = pack_lattice(s, {}).bed.pellets;
  EXPECT_LT(pellets[0].pose.position.x(), -2 * s.lattice.voxel);
  EXPECT_GT(pellets[1].pose.position.x(), 1e-3 + 2 * s.lattice.voxel);
}

TEST(Lattice, AnyContainerAndAMeshPellet) {
  Scene s = pour("digipac");
  auto prism = std::make_shared<Shape>(*test::cylinder(4e-3, 3e-3));
  prism->kind = ShapeClass::mesh;
  s.pellets = {{prism, 1000, 1}};
  s.feed.count = 20;
  // a round cup of 96 facets as a mesh: outer wall, inner wall, floor
  TriangleMesh cup = test::prism(12e-3, 21e-3, 96), inner = test::prism(10e-3, 20e-3, 96);
  for (Vec3& v : cup.vertices) v.z() += 19e-3;
  const int base = static_cast<int>(cup.vertices.size());
  for (const Vec3& v : inner.vertices) cup.vertices.push_back(v + Vec3(0, 0, 20.0001e-3));
  for (const auto& t : inner.triangles) cup.triangles.push_back({base + t[0], base + t[2], base + t[1]});
  s.container = Container{};
  s.container.kind = ContainerKind::mesh;
  s.container.radius = 9.9e-3;
  s.container.height = 39e-3;
  s.container.surface = cup;
  s.feed.radius = 5e-3;
  s.feed.drop_height = 30e-3;
  const PackResult result = pack_lattice(s, {});
  EXPECT_EQ(audit_of(result.record), "");
  EXPECT_EQ(result.bed.pellets.size(), 20u);
  for (const Pellet& p : result.bed.pellets) EXPECT_LT(p.pose.position.head<2>().norm(), 10e-3);
}

/// The message that a scene is refused with.
std::string refusal(const Scene& scene) {
  try {
    pack_lattice(scene, {});
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Lattice, RefusesAPelletThinnerThanTwoVoxels) {
  Scene s = pour("digipac");
  s.lattice.voxel = 1.6e-3;
  const std::string message = refusal(s);
  EXPECT_NE(message.find("at most 1.5 mm"), std::string::npos) << message;
  s.lattice.voxel = 1.5e-3;
  s.lattice.max_steps = 10;
  EXPECT_EQ(refusal(s), "");
}

TEST(Lattice, PacksAThinnerPelletWhenAskedToAndSaysSo) {
  Scene s = pour("digipac");
  s.lattice.voxel = 1.6e-3;
  s.lattice.thin = true;
  s.lattice.max_steps = 10;
  const std::vector<std::string> notes = pack_lattice(s, {}).record.notes;
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("1.5 mm would do"), std::string::npos) << notes[0];
}

TEST(Lattice, RefusesALatticeLargerThanTheMemoryAndNamesAVoxelThatFits) {
  Scene s = pour("digipac");
  s.lattice.memory_MB = 1;
  s.lattice.voxel = 0.05e-3;
  const std::string message = refusal(s);
  const std::size_t at = message.find("lattice.voxel = \"");
  ASSERT_NE(at, std::string::npos) << message;
  s.lattice.voxel =
      std::stod(message.substr(at + 17)) * (message.find(" um\"") != std::string::npos ? 1e-6 : 1e-3);
  EXPECT_GT(s.lattice.voxel, 0.05e-3);
  s.lattice.max_steps = 1;
  EXPECT_EQ(refusal(s), "") << s.lattice.voxel;
}

TEST(Lattice, RefusesAPlane) {
  Scene s = pour("digipac");
  s.container.kind = ContainerKind::plane;
  s.feed.radius = 5e-3;
  EXPECT_NE(refusal(s).find("a container with sides"), std::string::npos);
}

}  // namespace
}  // namespace packbed
