// The one entry: what is asked for, sections, definitions, threads, grids without a bed.
#include "analysis/analyse.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/layout.hpp"
#include "bed/voxelise.hpp"
#include "make_bed.hpp"
#include "math/error.hpp"
#include "math/threads.hpp"

namespace packbed {

using test::add;

TEST(Section, IsAsWishedInAHighBedAndCutShortInALowOne) {
  const AnalysisWish wish;
  const Section high = middle_section(30, 1, wish);
  EXPECT_EQ(high.from, 3);
  EXPECT_EQ(high.to, 17);
  EXPECT_FALSE(high.clipped);
  const Section low = middle_section(14, 1, wish);  // 3 dp is lower than a quarter of the height
  EXPECT_EQ(low.from, 3);
  EXPECT_EQ(low.to, 12);
  EXPECT_TRUE(low.clipped);
  const Section lower = middle_section(6, 1, wish);  // a quarter of the height is lower
  EXPECT_EQ(lower.from, 1.5);
  EXPECT_EQ(lower.to, 4);
  const Section lowest = middle_section(2, 1, wish);
  EXPECT_EQ(lowest.from, 0.5);
  EXPECT_EQ(lowest.to, 1.5);
}

TEST(Analyse, SaysOfWhatTheDensityIs) {
  PackedBed bed = test::spread_bed(test::a38(), 12e-3, 40e-3, 5e-3);
  const AnalysisResult r = analyse_bed(bed, {});
  EXPECT_NE(r.bulk.definition.find("tube of 24 mm"), std::string::npos) << r.bulk.definition;
  EXPECT_NE(r.bulk.definition.find("voxels of 0.1 mm"), std::string::npos);
  EXPECT_NE(r.bulk.definition.find("cut short"), std::string::npos);
}

TEST(Analyse, SkipsWhatTheWishDoesNotAskFor) {
  PackedBed bed = test::spread_bed(test::a38(), 12e-3, 40e-3, 5e-3);
  AnalysisWish wish;
  wish.voxels = wish.orientation = wish.exact = wish.overlap = false;
  const AnalysisResult none = analyse_bed(bed, wish);
  EXPECT_TRUE(none.axial.density.empty() && none.axial.exact.empty() && none.radial.exact.empty());
  EXPECT_FALSE(none.planar || none.orientation || none.overlap);
  EXPECT_TRUE(std::isnan(none.bulk.packing_density) && std::isnan(none.bulk.exact));
  EXPECT_EQ(none.voxelise_cpu_s, 0);
  wish.exact = true;
  const AnalysisResult exact = analyse_bed(bed, wish);
  EXPECT_TRUE(exact.axial.density.empty());
  EXPECT_EQ(exact.axial.exact.size(), exact.axial.x_m.size());
  EXPECT_GT(exact.bulk.axial_sd, 0);
  EXPECT_EQ(exact.bulk.voxel_m, 0);
}

TEST(Analyse, AnEmptyBedHasNoHeightAndNoCurves) {
  const AnalysisResult r = analyse_bed(test::tube_bed({test::a38()}, 0.02), {});
  EXPECT_EQ(r.bed_height_m, 0);
  EXPECT_TRUE(r.axial.x_m.empty());
}

TEST(Analyse, ResultsAreTheSameForAnyNumberOfThreads) {
  PackedBed bed = test::spread_bed(test::a38(), 12e-3, 40e-3, 3.5e-3);  // some overlap
  set_threads(1);
  const AnalysisResult one = analyse_bed(bed, {});
  for (int threads : {2, 4}) {
    set_threads(threads);
    const AnalysisResult many = analyse_bed(bed, {});
    EXPECT_EQ(many.axial.density, one.axial.density);
    EXPECT_EQ(many.axial.exact, one.axial.exact);
    EXPECT_EQ(many.radial.density, one.radial.density);
    EXPECT_EQ(many.radial.exact, one.radial.exact);
    EXPECT_EQ(many.bulk.exact, one.bulk.exact);
    EXPECT_EQ(many.overlap->mean, one.overlap->mean);
    EXPECT_EQ(many.overlap->volume, one.overlap->volume);
  }
  set_threads(1);
}

TEST(Analyse, AGridByItselfGivesTheCurvesThatItGivesWithItsBed) {
  const PackedBed bed = test::spread_bed(test::a38(), 12e-3, 40e-3, 5e-3);
  VoxelGrid grid;
  AnalysisWish wish;
  wish.to_diameters = 8;  // well under the top, which a grid knows to a voxel only
  const AnalysisResult with_bed = analyse_bed(bed, wish, &grid);
  EXPECT_EQ(grid.words, voxelise(bed, frame_for(bed, wish.voxel)).words);
  EXPECT_THROW(analyse_grid(grid, 12e-3, wish), InputError);  // whose diameter?
  wish.diameter = with_bed.bulk.diameter_m;
  const AnalysisResult alone = analyse_grid(grid, 12e-3, wish);
  EXPECT_EQ(alone.axial.density, with_bed.axial.density);
  EXPECT_EQ(alone.bulk.packing_density, with_bed.bulk.packing_density);
  EXPECT_NEAR(alone.bed_height_m, with_bed.bed_height_m, wish.voxel);
}

// Rings weigh by the voxels counted in them: all rings together are the section's density.
TEST(Radial, RingsTogetherAreTheBulkDensity) {
  const PackedBed bed = test::spread_bed(test::a38(), 12e-3, 60e-3, 5e-3);
  AnalysisWish wish;
  wish.to_diameters = 10;
  const AnalysisResult r = analyse_bed(bed, wish);
  double solid = 0, all = 0;
  const double width = r.radial.x_m[1] - r.radial.x_m[0], radius = bed.container.radius;
  for (std::size_t k = 0; k < r.radial.exact.size(); ++k) {
    const double outer = radius - static_cast<double>(k) * width, inner = std::max(0.0, outer - width);
    const double area = outer * outer - inner * inner;
    solid += r.radial.exact[k] * area;
    all += area;
  }
  EXPECT_NEAR(solid / all, r.bulk.exact, 5e-5);
  double planar = 0, cells = 0;
  for (const float d : r.planar->density)
    if (std::isfinite(d)) {
      planar += static_cast<double>(d);
      cells += 1;
    }
  EXPECT_NEAR(planar / cells, r.bulk.packing_density, 1e-6);
}

// A body that fills the tube leaves no void at any distance, and nothing above it.
TEST(Profiles, AFullTubeHasDensityOneUpToItsTop) {
  PackedBed bed = test::tube_bed({test::cylinder(20e-3, 10e-3)}, 10e-3);
  add(bed, {0, 0, 5e-3});
  AnalysisWish wish;
  wish.diameter = 1e-3;
  wish.from_diameters = 2;
  wish.to_diameters = 8;
  const AnalysisResult r = analyse_bed(bed, wish);
  for (const double d : r.axial.density) EXPECT_EQ(d, 1);
  for (const double d : r.radial.density) EXPECT_EQ(d, 1);
  for (const double d : r.axial.exact) EXPECT_NEAR(d, 1, 1e-12);
  for (const double d : r.radial.exact) EXPECT_NEAR(d, 1, 1e-9);
  EXPECT_EQ(r.bulk.axial_sd, 0);
}

TEST(Profiles, OfAContainerMeshCountItsInsideOnly) {
  PackedBed bed = test::free_bed({test::mesh_body(test::box({4e-3, 4e-3, 1e-3}), 128e-9, 2e-3)});
  bed.container.kind = ContainerKind::mesh;
  bed.container.surface = test::square_cup(4e-3, 20e-3, 1e-3);
  bed.container.radius = 4e-3;
  for (int i = 0; i < 5; ++i)
    add(bed, {0, 0, 1e-3 + i * 3e-3});  // slabs that fill the cup, 2 mm high, 1 mm apart
  AnalysisWish wish;
  wish.voxel = 0.25e-3;
  wish.diameter = 1e-3;
  wish.from_diameters = 3;
  wish.to_diameters = 12;
  const AnalysisResult r = analyse_bed(bed, wish);
  EXPECT_NEAR(r.bulk.packing_density, 2.0 / 3, 1e-12);
  EXPECT_TRUE(r.axial.exact.empty());
  for (std::size_t k = 0; k < r.axial.x_m.size(); ++k)
    EXPECT_EQ(r.axial.density[k], std::fmod(r.axial.x_m[k], 3e-3) < 2e-3 ? 1 : 0);
}

}  // namespace packbed
