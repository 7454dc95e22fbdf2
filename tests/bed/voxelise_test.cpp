// The voxeliser against its own definition, against volumes, and against itself on other threads.
#include "bed/voxelise.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "../shapes.hpp"
#include "lattice/rasterise.hpp"
#include "math/error.hpp"
#include "math/random.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

std::int64_t count(const VoxelGrid& grid) {
  std::int64_t n = 0;
  for (const std::uint64_t w : grid.words) n += std::popcount(w);
  return n;
}

GridFrame cube(double size, double pitch) {
  GridFrame f;
  const int n = static_cast<int>(std::lround(size / pitch));
  f.origin = Vec3::Constant(-0.5 * n * pitch);
  f.pitch = pitch;
  f.size = {n, n, n};
  return f;
}

PackedBed bed_of(const std::shared_ptr<Shape>& shape, const std::vector<Pose>& poses) {
  PackedBed bed;
  bed.container.kind = ContainerKind::none;
  bed.shapes = {shape};
  for (const Pose& pose : poses) {
    Pellet p;
    p.id = static_cast<std::uint32_t>(bed.pellets.size());
    p.pose = pose;
    bed.pellets.push_back(p);
  }
  return bed;
}

PackedBed random_bed(const std::shared_ptr<Shape>& shape, int pellets, double radius, double height) {
  std::vector<Pose> poses;
  for (int i = 0; i < pellets; ++i) {
    Random r(3, Stream::test, static_cast<std::uint32_t>(i));
    const Vec3 at(r.uniform(-radius, radius), r.uniform(-radius, radius), r.uniform(0, height));
    poses.push_back({at, r.rotation()});
  }
  return bed_of(shape, poses);
}

Quat quarter_turns(int about_x, int about_y, int about_z) {
  const auto turn = [](int n, const Vec3& axis) { return Quat(Eigen::AngleAxisd(n * kPi / 2, axis)); };
  return turn(about_x, Vec3::UnitX()) * turn(about_y, Vec3::UnitY()) * turn(about_z, Vec3::UnitZ());
}

}  // namespace

TEST(Frame, TheTubeLcAtATenthOfAMillimetreIs445By445By1200) {
  Container tube;
  tube.kind = ContainerKind::tube;
  tube.radius = 22.25e-3;
  const GridFrame f = frame_for(tube, 0.1e-3, 0.12);
  EXPECT_EQ(f.size, (std::array{445, 445, 1200}));
  EXPECT_NEAR(f.origin.x(), -22.25e-3, 1e-15);
  EXPECT_EQ(f.origin.z(), 0);
}

TEST(Frame, ImpossiblePitchesAreRefused) {
  Container tube;
  tube.kind = ContainerKind::tube;
  tube.radius = 0.02;
  EXPECT_THROW(frame_for(tube, 0, 0.1), InputError);
  EXPECT_THROW(frame_for(tube, -1e-4, 0.1), InputError);
  EXPECT_THROW(frame_for(tube, std::nan(""), 0.1), InputError);
  EXPECT_THROW(frame_for(tube, 1e-9, 0.1), InputError);  // 10^21 voxels
}

TEST(Parity, EveryRowOfAClosedMeshClosesInAnyPose) {
  const double pitch = 0.1e-3;
  const GridFrame frame = cube(8e-3, pitch);
  Rasteriser rasteriser(frame);
  const std::vector<TriangleMesh> meshes{test::prism(1.71e-3, 1.73e-3, 36), test::box({1e-3, 1.5e-3, 2e-3}),
                                         test::square_cup(1e-3, 2e-3, 0.2e-3)};
  for (std::uint32_t i = 0; i < 900; ++i) {
    Random r(1, Stream::test, i);
    const Vec3 at(r.uniform(-1e-4, 1e-4), r.uniform(-1e-4, 1e-4), r.uniform(-1e-4, 1e-4));
    rasteriser.mesh(meshes[i % 3], {at, r.rotation()}, 1, 0, frame.size[2]);
  }
  EXPECT_GE(rasteriser.rows(), 1'000'000);
  EXPECT_EQ(rasteriser.open_rows(), 0);
}

// Vertices, edges and faces exactly on planes of voxel centres: where a rule that counts a crossing twice or
// not at all would show.
TEST(Parity, EveryRowClosesWithVerticesOnTheLattice) {
  const double pitch = 0.125e-3;  // a power of two in millimetres: positions are exact
  const GridFrame frame = cube(8e-3, pitch);
  Rasteriser rasteriser(frame);
  const std::vector<TriangleMesh> meshes{test::box({1e-3, 1.5e-3, 2e-3}),
                                         test::square_cup(1e-3, 2e-3, 0.25e-3),
                                         test::prism(1.75e-3, 1.75e-3, 8)};
  for (int i = 0; i < 64 * 27; ++i) {
    const Vec3 at = pitch / 2 * Vec3(i / 64 % 3, i / 192 % 3, i / 576 % 3);
    rasteriser.mesh(meshes[static_cast<std::size_t>(i) % 3],
                    {at, quarter_turns(i % 4, i / 4 % 4, i / 16 % 4)}, 1, 0, frame.size[2]);
  }
  EXPECT_GE(rasteriser.rows(), 1'000'000);
  EXPECT_EQ(rasteriser.open_rows(), 0);
}

TEST(Parity, AMeshWithAHoleIsNoticed) {
  TriangleMesh mesh = test::box({1e-3, 1e-3, 1e-3});
  mesh.triangles.pop_back();
  const GridFrame frame = cube(4e-3, 0.1e-3);
  Rasteriser rasteriser(frame);
  for (std::uint32_t i = 0; i < 10; ++i)
    rasteriser.mesh(mesh, {Vec3::Zero(), Random(2, Stream::test, i).rotation()}, 1, 0, 40);
  EXPECT_GT(rasteriser.open_rows(), 0);
}

// A box that is a whole number of voxels wide holds exactly so many, wherever it lies on the lattice: a plane
// of voxel centres belongs to one side of it only.
TEST(Parity, AFaceThroughVoxelCentresIsCountedOnce) {
  const double pitch = 0.125e-3;
  for (int shift = 0; shift < 4; ++shift) {
    const Vec3 at = Vec3::Constant(shift * pitch / 4);
    const VoxelGrid grid =
        voxelise(bed_of(test::mesh_body(test::box({1e-3, 1e-3, 1e-3}), 8e-9, 2e-3), {{at, Quat::Identity()}}),
                 cube(4e-3, pitch));
    EXPECT_EQ(count(grid), 16 * 16 * 16) << shift;
  }
}

TEST(CentroidRule, AVoxelIsSolidWhenItsCentreIsInside) {
  const GridFrame frame = cube(6e-3, 0.15e-3);
  const auto cylinder = test::a38(), sphere = test::sphere(1.71e-3);
  for (std::uint32_t i = 0; i < 20; ++i) {
    Random r(4, Stream::test, i);
    const Pose pose{Vec3(r.uniform(-1e-3, 1e-3), r.uniform(-1e-3, 1e-3), r.uniform(-1e-3, 1e-3)),
                    i == 0 ? quarter_turns(0, 1, 0) : r.rotation()};
    const VoxelGrid c = voxelise(bed_of(cylinder, {pose}), frame),
                    s = voxelise(bed_of(sphere, {pose}), frame);
    for (int z = 0; z < frame.size[2]; ++z)
      for (int y = 0; y < frame.size[1]; ++y)
        for (int x = 0; x < frame.size[0]; ++x) {
          const Vec3 own = pose.to_local(frame.centre(x, y, z));
          const double in_cylinder =
              std::min(cylinder->radius - own.head<2>().norm(), cylinder->half_height - std::abs(own.z()));
          const double in_sphere = sphere->radius - own.norm();
          if (std::abs(in_cylinder) > 1e-12) {
            ASSERT_EQ(c.solid(x, y, z), in_cylinder > 0);
          }
          if (std::abs(in_sphere) > 1e-12) {
            ASSERT_EQ(s.solid(x, y, z), in_sphere > 0);
          }
        }
  }
}

TEST(CentroidRule, AMeshFollowsItsFacesToTheSnapLength) {
  const GridFrame frame = cube(6e-3, 0.15e-3);
  const Vec3 half(1e-3, 1.5e-3, 2e-3);
  const double snap = 2 * frame.pitch / static_cast<double>(kSnap);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Pose pose{Vec3::Zero(), Random(5, Stream::test, i).rotation()};
    const VoxelGrid grid = voxelise(bed_of(test::mesh_body(test::box(half), 24e-9, 2e-3), {pose}), frame);
    for (int z = 0; z < frame.size[2]; ++z)
      for (int y = 0; y < frame.size[1]; ++y)
        for (int x = 0; x < frame.size[0]; ++x) {
          const double inside = (half - pose.to_local(frame.centre(x, y, z)).cwiseAbs()).minCoeff();
          if (std::abs(inside) > snap) {
            ASSERT_EQ(grid.solid(x, y, z), inside > 0);
          }
        }
  }
}

// The wide path of the integers (more than 128 voxels across) and the narrow one are one rule.
TEST(CentroidRule, LargeMeshesFollowTheSameRule) {
  const GridFrame frame = cube(6e-3, 0.02e-3);
  const Vec3 half(1e-3, 1.5e-3, 2e-3);
  const Pose pose{Vec3::Zero(), Random(6, Stream::test, 0).rotation()};
  Rasteriser rasteriser(frame);
  const BitBlock& block = rasteriser.mesh(test::box(half), pose, 1, 0, frame.size[2]);
  EXPECT_EQ(rasteriser.open_rows(), 0);
  VoxelGrid grid(frame);
  merge(block, grid, 1);
  EXPECT_NEAR(static_cast<double>(count(grid)) * std::pow(frame.pitch, 3), 24e-9, 24e-9 * 2e-4);
  int wrong = 0;
  for (int z = 0; z < frame.size[2]; z += 7)
    for (int y = 0; y < frame.size[1]; ++y)
      for (int x = 0; x < frame.size[0]; ++x) {
        const double inside = (half - pose.to_local(frame.centre(x, y, z)).cwiseAbs()).minCoeff();
        wrong += std::abs(inside) > 2 * frame.pitch / static_cast<double>(kSnap) &&
                 grid.solid(x, y, z) != (inside > 0);
      }
  EXPECT_EQ(wrong, 0);
}

// Relative rms error of the volume of one A38 over random poses: at most 1.5 times what was measured for this
// rule.
TEST(Volume, ErrorFallsWithTheSquareOfTheVoxel) {
  const auto shape = test::a38();
  const std::vector<std::pair<double, double>> measured{
      {0.4e-3, 9.9e-3}, {0.2e-3, 2.2e-3}, {0.1e-3, 5.0e-4}, {0.05e-3, 1.4e-4}};
  for (const auto& [pitch, rms] : measured) {
    const GridFrame frame = cube(6.4e-3, pitch);
    Rasteriser rasteriser(frame);
    const int poses = 300;
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < poses; ++i) {
      Random r(7, Stream::test, i);
      const Vec3 at(r.uniform(0, pitch), r.uniform(0, pitch), r.uniform(0, pitch));
      const BitBlock& block = rasteriser.body(*shape, {at, r.rotation()}, 1, 0, frame.size[2]);
      std::int64_t solid = 0;
      for (const std::uint64_t w : block.bits) solid += std::popcount(w);
      const double error = static_cast<double>(solid) * pitch * pitch * pitch / shape->volume - 1;
      sum += error;
      squares += error * error;
    }
    const double found = std::sqrt(squares / poses);
    RecordProperty("rms_" + std::to_string(static_cast<int>(pitch * 1e6)) + "um", std::to_string(found));
    std::printf("voxel %.2f mm: volume error of an A38, rms %.2e, mean %+.1e\n", 1e3 * pitch, found,
                sum / poses);
    EXPECT_LT(found, 1.5 * rms);
    EXPECT_LT(std::abs(sum / poses), 4 * found / std::sqrt(poses));
  }
}

// A prism of n sides and the volume of the cylinder differs from it by the segments outside and inside the
// circle: the symmetric difference is bounded by the ring between its inner and outer radius.
TEST(Volume, FacetsDifferFromTheCylinderByTheirSagittaOnly) {
  const auto exact = test::a38();
  const double r = exact->radius, height = 2 * exact->half_height;
  for (int facets : {24, 48, 96}) {
    const auto faceted = test::mesh_body(exact->surface, exact->volume, r);
    faceted->surface = test::prism(r, exact->half_height, facets);
    const double outer = r * std::sqrt((2 * kPi / facets) / std::sin(2 * kPi / facets)),
                 inner = outer * std::cos(kPi / facets);
    const double ring = kPi * (outer * outer - inner * inner) * height;
    const GridFrame frame = cube(6e-3, 0.05e-3);
    for (std::uint32_t i = 0; i < 5; ++i) {
      const std::vector<Pose> pose{{Vec3::Zero(), Random(8, Stream::test, i).rotation()}};
      const VoxelGrid a = voxelise(bed_of(exact, pose), frame), b = voxelise(bed_of(faceted, pose), frame);
      std::int64_t differ = 0;
      for (std::size_t w = 0; w < a.words.size(); ++w) differ += std::popcount(a.words[w] ^ b.words[w]);
      EXPECT_LT(static_cast<double>(differ) * std::pow(frame.pitch, 3), ring);
      EXPECT_NEAR(static_cast<double>(count(a)), static_cast<double>(count(b)),
                  1e-3 * static_cast<double>(count(a)));
    }
  }
}

TEST(Labels, AVoxelKeepsTheFirstPelletAndTheRestIsCountedAsDoubled) {
  const double r = 1.5e-3, apart = 2e-3;
  const auto bed = bed_of(test::sphere(r), {{Vec3(-apart / 2, 0, 0), Quat::Identity()},
                                            {Vec3(apart / 2, 0, 0), Quat::Identity()}});
  const VoxelGrid grid = voxelise(bed, cube(6e-3, 0.05e-3), true);
  const double voxel = std::pow(grid.frame.pitch, 3),
               lens = kPi * (4 * r + apart) * std::pow(2 * r - apart, 2) / 12;
  EXPECT_NEAR(static_cast<double>(grid.doubled) * voxel, lens, 0.01 * lens);
  std::int64_t first = 0, second = 0;
  for (std::size_t i = 0; i < grid.labels.size(); ++i) {
    first += grid.labels[i] == 1;
    second += grid.labels[i] == 2;
  }
  EXPECT_EQ(first + second, count(grid));
  EXPECT_EQ(first - second, grid.doubled);  // both spheres have the same number of voxels, by symmetry
}

TEST(Threads, TheGridIsTheSameForAnyNumber) {
  const auto bed =
      random_bed(test::mesh_body(test::prism(1.71e-3, 1.73e-3, 24), 31.78e-9, 3.4e-3), 150, 10e-3, 30e-3);
  const GridFrame frame = frame_for(bed, 0.15e-3);
  set_threads(1);
  const VoxelGrid one = voxelise(bed, frame, true);
  for (int threads : {2, 4}) {
    set_threads(threads);
    const VoxelGrid many = voxelise(bed, frame, true);
    EXPECT_EQ(many.words, one.words);
    EXPECT_EQ(many.labels, one.labels);
    EXPECT_EQ(many.doubled, one.doubled);
  }
  set_threads(1);
}

TEST(Grid, BitsBeyondTheRowsEndStayZeroAndPelletsOutsideAreCut) {
  GridFrame frame;
  frame.pitch = 0.1e-3;
  frame.size = {70, 20, 20};  // the row ends six bits into its second word
  const auto bed = bed_of(test::sphere(5e-3), {{Vec3(6.9e-3, 1e-3, 1e-3), Quat::Identity()},
                                               {Vec3(-1, 0, 0), Quat::Identity()},
                                               {Vec3(1, 0, 0), Quat::Identity()}});
  const VoxelGrid grid = voxelise(bed, frame);
  EXPECT_GT(count(grid), 0);
  for (int z = 0; z < 20; ++z)
    for (int y = 0; y < 20; ++y) EXPECT_EQ(grid.words[grid.row(y, z) + 1] >> 6, 0U);
}

TEST(Space, OfATubeIsItsDisc) {
  Container tube;
  tube.kind = ContainerKind::tube;
  tube.radius = 22.25e-3;
  const GridFrame frame = frame_for(tube, 0.1e-3, 0.01);
  const VoxelGrid space = container_space(tube, frame);
  EXPECT_EQ(space.frame.size[2], 1);
  const double disc = kPi * tube.radius * tube.radius;
  EXPECT_NEAR(static_cast<double>(count(space)) * frame.pitch * frame.pitch, disc, 2e-4 * disc);
}

TEST(Space, OfAContainerMeshIsWhatItsWallEncloses) {
  Container cup;
  cup.kind = ContainerKind::mesh;
  cup.surface = test::square_cup(4e-3, 6e-3, 1e-3);
  GridFrame frame = frame_for(cup, 0.25e-3, 8e-3);
  EXPECT_EQ(frame.size, (std::array{42, 42, 32}));
  frame.origin.z() = -1e-3;  // from under the floor
  const VoxelGrid space = container_space(cup, frame);
  for (int z = 0; z < frame.size[2]; ++z) {
    const double height = frame.centre(0, 0, z).z();
    std::int64_t inside = 0;
    for (std::size_t w = space.row(0, z); w < space.row(0, z) + frame.words_per_row() * 42; ++w)
      inside += std::popcount(space.words[w]);
    EXPECT_EQ(inside, height > 0 && height < 6e-3 ? 32 * 32 : 0) << height;
  }
}

TEST(PartialVolume, IsTheCentroidRuleForOnePointAndNearerToTheVolumeForMore) {
  const auto shape = test::a38();
  const auto bed = bed_of(shape, {{Vec3(0.03e-3, 0.07e-3, 0), Random(9, Stream::test, 0).rotation()}});
  const GridFrame frame = cube(5.2e-3, 0.4e-3);
  const auto volume = [&](int k) {
    double sum = 0;
    for (const float f : partial_volume(bed, frame, k)) sum += f;
    return sum * std::pow(frame.pitch, 3);
  };
  EXPECT_NEAR(volume(1), static_cast<double>(count(voxelise(bed, frame))) * std::pow(frame.pitch, 3), 1e-15);
  EXPECT_NEAR(volume(8), shape->volume, 1e-3 * shape->volume);
  EXPECT_THROW(partial_volume(bed, frame, kMostPoints + 1), InputError);
}

TEST(Bed, TopAndHashFollowThePose) {
  auto bed = bed_of(test::a38(), {{Vec3(0, 0, 5e-3), Quat::Identity()}});
  EXPECT_NEAR(bed_top(bed), 5e-3 + 1.73e-3, 1e-15);
  const std::string before = bed_hash(bed);
  EXPECT_EQ(before.size(), 16U);
  bed.pellets[0].pose.rotation = Quat(Eigen::AngleAxisd(kPi / 4, Vec3::UnitX()));
  EXPECT_NEAR(bed_top(bed), 5e-3 + (1.73e-3 + 1.71e-3) / std::sqrt(2.0), 1e-15);
  EXPECT_NE(bed_hash(bed), before);
  bed.pellets.clear();
  EXPECT_EQ(bed_top(bed), 0);
}

}  // namespace packbed
