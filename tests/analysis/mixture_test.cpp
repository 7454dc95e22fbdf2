// Segregation, sizes and coordination of beds of many sizes.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/analyse.hpp"
#include "analysis/coordination.hpp"
#include "analysis/make_bed.hpp"
#include "analysis/segregation.hpp"
#include "analysis/size_rows.hpp"

namespace packbed {
namespace {

void add_sphere(PackedBed& bed, double scale, const Vec3& position) {
  test::add(bed, position);
  bed.pellets.back().scale = scale;
}

TEST(Segregation, IsOneWhenSizeGrowsWithHeightAndMinusOneUpsideDown) {
  PackedBed bed = test::free_bed({test::sphere(1e-3)});
  for (int i = 1; i <= 9; ++i) add_sphere(bed, i, {0, 1e-3 * (i % 3), 2e-3 * i});
  EXPECT_NEAR(segregation(bed).along[2], 1, 1e-12);
  EXPECT_TRUE(std::isnan(segregation(bed).along[0]));  // all at x = 0
  for (Pellet& p : bed.pellets) p.pose.position.z() *= -1;
  EXPECT_NEAR(segregation(bed).along[2], -1, 1e-12);
}

TEST(Segregation, OfTwoAndTwoByHand) {
  PackedBed bed = test::free_bed({test::sphere(0.5)});
  // diameters 1 1 3 3 at heights 0 2 1 3: deviations -1 -1 1 1 and -1.5 0.5 -0.5 1.5, products sum to 2
  add_sphere(bed, 1, {0, 0, 0});
  add_sphere(bed, 1, {0, 0, 2});
  add_sphere(bed, 3, {0, 0, 1});
  add_sphere(bed, 3, {0, 0, 3});
  EXPECT_NEAR(segregation(bed).along[2], 2 / std::sqrt(4.0 * 5.0), 1e-12);
}

TEST(Segregation,
     OfRandomPlacesIsOneOverTheRootOfTheirNumber) {  // standard error of a correlation of nothing
  double squares = 0;
  constexpr int kBeds = 40, kPellets = 400;
  for (std::uint32_t b = 0; b < kBeds; ++b) {
    PackedBed bed = test::free_bed({test::sphere(1e-3)});
    Random random(9, Stream::test, b);
    for (int i = 0; i < kPellets; ++i) add_sphere(bed, i % 4 ? 1 : 3, {0, 0, random.uniform()});
    squares += std::pow(segregation(bed).along[2], 2) * kPellets / kBeds;
  }
  EXPECT_NEAR(squares, 1, 4 * std::sqrt(2.0 / kBeds));
}

TEST(Segregation, OfEqualPelletsDoesNotExist) {
  PackedBed bed = test::free_bed({test::sphere(1e-3)});
  for (int i = 0; i < 5; ++i) test::add(bed, {0, 0, 3e-3 * i});
  EXPECT_TRUE(std::isnan(segregation(bed).along[2]));
  EXPECT_FALSE(analyse_bed(bed, {}).segregation);
}

TEST(Mixture, ProfilesOfScaledPelletsAreThoseOfPelletsSoLarge) {
  PackedBed scaled = test::tube_bed({test::sphere(2e-3), test::cylinder(3e-3, 4e-3)}, 12e-3);
  PackedBed large = test::tube_bed({test::sphere(1e-3), test::cylinder(1.5e-3, 2e-3)}, 12e-3);
  Random random(4, Stream::test, 7);
  for (std::uint32_t i = 0; i < 60; ++i) {
    const double r = 9e-3 * std::sqrt(random.uniform()), angle = random.uniform(0, 2 * kPi);
    const Vec3 place(r * std::cos(angle), r * std::sin(angle), random.uniform(2e-3, 30e-3));
    const Quat rotation = random.rotation();
    test::add(scaled, place, rotation, i % 2);
    test::add(large, place, rotation, i % 2);
    scaled.pellets.back().scale = 0.5;
  }
  AnalysisWish wish;
  wish.voxel = 0.25e-3;
  wish.from_diameters = 1;
  wish.to_diameters = 8;
  const AnalysisResult a = analyse_bed(scaled, wish), b = analyse_bed(large, wish);
  EXPECT_NEAR(a.bulk.diameter_m, b.bulk.diameter_m, 1e-15);
  const auto expect_same = [](const std::vector<double>& x, const std::vector<double>& y, double within) {
    ASSERT_EQ(x.size(), y.size());
    ASSERT_FALSE(x.empty());
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], within);
  };
  expect_same(a.axial.exact, b.axial.exact, 1e-9);
  expect_same(a.radial.exact, b.radial.exact, 1e-9);
  expect_same(a.axial.density, b.axial.density, 1e-9);
  expect_same(a.radial.density, b.radial.density, 1e-9);
  EXPECT_NEAR(a.overlap->volume, b.overlap->volume, 1e-6 * b.overlap->volume);
}

TEST(SizeRows, CountWhatIsThereBesideWhatWasAsked) {
  PackedBed bed = test::free_bed({test::sphere(2e-3)});
  for (int i = 0; i < 30; ++i) add_sphere(bed, i % 3 ? 0.5 : 1, {0, 0, 5e-3 * i});
  std::vector<SizeRow> rows = size_rows(bed);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].count, 10);
  EXPECT_DOUBLE_EQ(rows[0].diameter_m, 4e-3);
  EXPECT_DOUBLE_EQ(rows[1].number, 2.0 / 3);
  EXPECT_NEAR(rows[1].volume, 20.0 / (20 + 80), 1e-12);
  PelletKind kind{bed.shapes[0], 1000, 1};
  kind.asked.law = SizeLaw::table;
  kind.asked.by = SizeBasis::number;
  kind.asked.diameter = {4e-3, 2e-3, 1e-3};
  kind.asked.amount = {30, 69, 1};
  kind.sizes = {{1, 10, 0.3}, {0.5, 20, 0.69}, {0.25, 0, 0.01}};
  add_asked(rows, {kind});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_NEAR(rows[0].asked_number, 0.3, 1e-12);
  EXPECT_NEAR(rows[1].asked_number, 0.69, 1e-12);
  EXPECT_NEAR(rows[2].asked_number, 0.01, 1e-12);
  EXPECT_EQ(rows[2].count, 0);
  EXPECT_NEAR(rows[0].asked_volume, 30 * 64.0 / (30 * 64 + 69 * 8 + 1), 1e-12);
}

TEST(SizeRows, ManySizesStandInClassesThatHoldThemAll) {
  PackedBed bed = test::free_bed({test::sphere(2e-3)});
  PelletKind kind{bed.shapes[0], 1000, 1};
  kind.asked.law = SizeLaw::log_normal;
  kind.asked.by = SizeBasis::number;
  kind.asked.modulus = 4e-3;
  kind.asked.deviation = 1.3;
  kind.asked.smallest = 2e-3;
  kind.asked.largest = 8e-3;
  kind.sizes = size_classes(kind.asked, 2000, 4e-3);
  for (const SizeClass& c : kind.sizes)
    add_sphere(bed, c.scale, {0, 0, 0.01 * static_cast<double>(bed.pellets.size())});
  std::vector<SizeRow> rows = size_rows(bed);
  add_asked(rows, {kind});
  ASSERT_EQ(rows.size(), kSizeClasses);
  double number = 0, volume = 0;
  int count = 0;
  for (const SizeRow& row : rows) {
    number += row.number;
    volume += row.volume;
    count += row.count;
    EXPECT_NEAR(row.number, row.asked_number, 1.0 / 2000);
    EXPECT_NEAR(row.volume, row.asked_volume, 3e-3);
  }
  EXPECT_NEAR(number, 1, 1e-12);
  EXPECT_NEAR(volume, 1, 1e-12);
  EXPECT_EQ(count, 2000);
}

TEST(SizeRows, OfEqualPelletsThereAreNone) {
  PackedBed bed = test::free_bed({test::sphere(2e-3)});
  for (int i = 0; i < 3; ++i) test::add(bed, {0, 0, 5e-3 * i});
  EXPECT_TRUE(size_rows(bed).empty());
}

TEST(Coordination, OfACubicLatticeIsSixInside) {
  PackedBed bed = test::tube_bed({test::sphere(1e-3)}, 20e-3);
  for (int z = 0; z < 9; ++z)
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x) test::add(bed, {1.999e-3 * x, 1.999e-3 * y, 0.999e-3 + 1.999e-3 * z});
  AnalysisWish wish;
  wish.voxel = 0.5e-3;
  wish.core_margin = 2;
  const AnalysisResult r = analyse_bed(bed, wish);
  ASSERT_TRUE(r.coordination);
  // 3 n^2 (n - 1) bonds of an n^3 lattice
  EXPECT_DOUBLE_EQ(r.coordination->mean, 2.0 * 3 * 81 * 8 / 729);
  EXPECT_EQ(r.coordination->histogram[3], 8);
  EXPECT_EQ(r.coordination->histogram[6], 343);
  EXPECT_EQ(r.coordination->rattlers, 8 - 4);  // the four lower corners stand on the floor
  EXPECT_EQ(r.coordination->source, "overlaps");
  const CoreRegion core{0, 5e-3, Vec2::Zero(), 3e-3, 15e-3};
  EXPECT_EQ(coordination(bed, find_overlaps(bed), {}, core).core, 6);
}

TEST(Coordination, BelievesTheForcesOfThePackerAndTellsSizesApart) {
  PackedBed bed = test::free_bed({test::sphere(1e-3)});
  add_sphere(bed, 2, {0, 0, 0});
  add_sphere(bed, 1, {0, 0, 3e-3});
  add_sphere(bed, 1, {0, 0, -3e-3});
  for (std::uint32_t i = 0; i < 3; ++i) bed.pellets[i].id = 10 + i;
  bed.contacts = {{10, 11, Vec3::Zero(), Vec3::Zero(), 1e-6},
                  {10, 12, Vec3::Zero(), Vec3::Zero(), 1e-6},
                  {11, kContainer, Vec3::Zero(), Vec3::Zero(), 1e-6},
                  {11, 12, Vec3::Zero(), Vec3::Zero(), 0}};  // apart
  const Coordination c = coordination(bed, {}, size_rows(bed), {});
  EXPECT_DOUBLE_EQ(c.mean, 4.0 / 3);
  EXPECT_EQ(c.by_size, (std::vector<double>{2, 1}));
  EXPECT_EQ(c.rattlers, 3);
  EXPECT_EQ(c.source, "forces of the packer");
  EXPECT_TRUE(std::isnan(c.core));
}

}  // namespace
}  // namespace packbed
