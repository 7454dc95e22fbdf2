// Porosity of the core: exact, from voxels and by shots, on beds whose porosity is known.
#include "analysis/core.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/analyse.hpp"
#include "analysis/make_bed.hpp"
#include "bed/voxelise.hpp"
#include "geometry/sphere_volume.hpp"

namespace packbed {
namespace {

/// Spheres of 2 mm and, in the holes, of 1 mm at random places that may overlap nothing: RSA in a tube.
PackedBed scattered_bed(std::uint64_t seed, double radius, double height, int wanted) {
  PackedBed bed = test::tube_bed({test::sphere(1e-3)}, radius);
  Random random(seed, Stream::test, 0);
  for (int i = 0; i < wanted; ++i) {
    Pellet p;
    p.id = static_cast<std::uint32_t>(i);
    p.scale = i % 3 ? 0.5 : 1;
    for (int draw = 0; draw < 200; ++draw) {
      const double room = radius - p.scale * 1e-3, r = room * std::sqrt(random.uniform()),
                   angle = random.uniform(0, 2 * kPi);
      p.pose.position = {r * std::cos(angle), r * std::sin(angle),
                         random.uniform(p.scale * 1e-3, height - p.scale * 1e-3)};
      const bool free = std::none_of(bed.pellets.begin(), bed.pellets.end(), [&](const Pellet& q) {
        return (q.pose.position - p.pose.position).norm() < 1e-3 * (p.scale + q.scale);
      });
      if (free) {
        bed.pellets.push_back(p);
        break;
      }
    }
  }
  return bed;
}

AnalysisWish core_wish() {
  AnalysisWish wish;
  wish.voxel = 0.1e-3;
  wish.core_margin = 1.5;
  wish.cell = 0.5e-3;
  return wish;
}

TEST(Core, LiesAMarginOfTheLargestAwayFromEverything) {
  const PackedBed bed = scattered_bed(1, 8e-3, 30e-3, 300);
  const AnalysisResult r = analyse_bed(bed, core_wish());
  ASSERT_TRUE(r.core);
  EXPECT_DOUBLE_EQ(r.core->margin_m, 3e-3);
  EXPECT_DOUBLE_EQ(r.core->z_range_m[0], 3e-3);
  EXPECT_DOUBLE_EQ(r.core->z_range_m[1], r.bed_height_m - 3e-3);
  EXPECT_NEAR(r.core->volume_m3, kPi * 25e-6 * (r.bed_height_m - 6e-3), 1e-15);
  EXPECT_EQ(r.core->best(), r.core->exact);
}

TEST(Core, EndsBelowTheTopOfWhatTouchesSomething) {
  PackedBed bed = scattered_bed(1, 8e-3, 30e-3, 300);
  for (const Pellet& p : bed.pellets)
    bed.contacts.push_back({p.id, kContainer, Vec3::Zero(), Vec3::Zero(), 0});
  const double top = bed_top(bed);
  test::add(bed, {0, 0, top + 20e-3});
  EXPECT_GT(bed_top(bed), top + 20e-3);
  EXPECT_DOUBLE_EQ(settled_top(bed), top);
  EXPECT_DOUBLE_EQ(analyse_bed(bed, core_wish()).core->z_range_m[1], top - 3e-3);
  bed.contacts.clear();  // nothing is known of who touches whom
  EXPECT_DOUBLE_EQ(settled_top(bed), bed_top(bed));
}

TEST(Core, ExactIsOneMinusTheSpheresThatLieInIt) {
  PackedBed bed = test::tube_bed({test::sphere(1e-3)}, 8e-3);
  const CoreRegion core{3e-3, 5e-3, Vec2::Zero(), 3e-3, 23e-3};
  test::add(bed, {0, 0, 10e-3});     // whole
  test::add(bed, {0, 0, 3e-3});      // half
  test::add(bed, {0, 0, 28e-3});     // not
  test::add(bed, {5e-3, 0, 15e-3});  // a little less than half
  const double ball = 4 * kPi / 3 * 1e-9, side = sphere_in_cylinder({5e-3, 0, 15e-3}, 1e-3, 5e-3, 0, 1);
  EXPECT_NEAR(exact_porosity(bed, core, {}), 1 - (1.5 * ball + side) / core.volume(), 1e-14);
  EXPECT_LT(side, ball / 2);
  EXPECT_GT(side, 0.45 * ball);
}

TEST(Core, WhatTwoSpheresShareCountsOnce) {
  PackedBed bed = test::tube_bed({test::sphere(1e-3)}, 8e-3);
  test::add(bed, {0, 0, 10e-3});
  test::add(bed, {0, 0, 11.9e-3});
  const CoreRegion core{3e-3, 5e-3, Vec2::Zero(), 3e-3, 23e-3};
  const double solid = 8 * kPi / 3 * 1e-9 - sphere_in_sphere(1e-3, 1e-3, 1.9e-3);
  EXPECT_NEAR(exact_porosity(bed, core, find_overlaps(bed)), 1 - solid / core.volume(), 1e-14);
}

TEST(Core, AnUprightBoxIsMeasuredLikeATube) {  // a cubic lattice of touching spheres: 1 - pi / 6
  PackedBed bed = test::free_bed({test::sphere(1e-3)});
  for (int z = 0; z < 12; ++z)
    for (int y = -5; y < 5; ++y)
      for (int x = -5; x < 5; ++x) test::add(bed, {2e-3 * x + 1e-3, 2e-3 * y + 1e-3, 2e-3 * z + 1e-3});
  const CoreRegion core{4e-3, 0, Vec2(6e-3, 4e-3), 4e-3, 20e-3};
  EXPECT_NEAR(exact_porosity(bed, core, {}), 1 - kPi / 6, 1e-12);
  EXPECT_NEAR(voxel_porosity(voxelise(bed, frame_for(bed, 0.05e-3)), core), 1 - kPi / 6, 2e-3);
  CorePorosity out;
  shoot_cells(bed, core, 0.5e-3, 10, out);
  EXPECT_EQ(out.cells, 24 * 16 * 32);
  EXPECT_EQ(out.shots_per_cell, 1000);
  EXPECT_NEAR(out.shots, 1 - kPi / 6, 2e-3);
}

TEST(Core, ShotsAgreeWithTheExactPorosityOfTheirCellsWithinTheirError) {
  double squares = 0;
  constexpr int kBeds = 12;
  for (int seed = 0; seed < kBeds; ++seed) {
    const PackedBed bed = scattered_bed(static_cast<std::uint64_t>(seed), 8e-3, 14e-3, 350);
    // a box of whole cells, so that both look at the same space
    const CoreRegion core{2e-3, 0, Vec2(4e-3, 4e-3), 3e-3, 11e-3};
    CorePorosity out;
    shoot_cells(bed, core, 1e-3, 10, out);
    ASSERT_EQ(out.cells, 8 * 8 * 8);
    const double off = (out.shots - exact_porosity(bed, core, {})) / out.shots_error;
    squares += off * off;
    EXPECT_LT(std::abs(off), 3) << seed;
    EXPECT_GT(out.cell_sd, 0.1);
  }
  std::printf("shots against exact: rms %.2f of their standard error over %d beds\n",
              std::sqrt(squares / kBeds), kBeds);
  EXPECT_LT(std::sqrt(squares / kBeds), 1);  // evenly spread points do better than independent ones
}

TEST(Core, VoxelsOfAnyShapeApproachTheExactPorosity) {
  const PackedBed bed = scattered_bed(3, 8e-3, 14e-3, 350);
  AnalysisWish wish = core_wish();
  const AnalysisResult spheres = analyse_bed(bed, wish);
  EXPECT_NEAR(spheres.core->voxels, spheres.core->exact, 2e-3);
  // the same grid without its pellets, as a CT volume is
  wish.diameter = 2e-3;
  const AnalysisResult grid = analyse_grid(voxelise(bed, frame_for(bed, wish.voxel)), 8e-3, wish);
  ASSERT_TRUE(grid.core);
  EXPECT_NEAR(grid.core->voxels, spheres.core->voxels, 1e-3);
  EXPECT_TRUE(std::isnan(grid.core->exact));
  EXPECT_EQ(grid.core->best(), grid.core->voxels);
  const PackedBed rods = test::spread_bed(test::a38(), 15e-3, 60e-3, 5e-3);
  const AnalysisResult r = analyse_bed(rods, wish);
  EXPECT_TRUE(std::isnan(r.core->exact));
  EXPECT_GT(r.core->voxels, 0.5);
}

TEST(Core, ABedTooSmallHasNoneAndSaysSo) {
  AnalysisWish wish = core_wish();
  wish.core_margin = 3;
  const AnalysisResult r = analyse_bed(scattered_bed(4, 5e-3, 10e-3, 60), wish);
  ASSERT_TRUE(r.core);
  EXPECT_EQ(r.core->volume_m3, 0);
  EXPECT_TRUE(std::isnan(r.core->best()));
  EXPECT_NE(r.core->definition.find("too small"), std::string::npos);
  PackedBed heap = test::free_bed({test::sphere(1e-3)});
  test::add(heap, {0, 0, 1e-3});
  EXPECT_FALSE(analyse_bed(heap, wish).core);  // no side walls
}

}  // namespace
}  // namespace packbed
