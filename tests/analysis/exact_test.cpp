// Voxel-free profiles against closed forms of single bodies, against each other, and against voxels.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "analysis/analyse.hpp"
#include "analysis/exact_axial.hpp"
#include "analysis/exact_radial.hpp"
#include "make_bed.hpp"

namespace packbed {
namespace {

using test::add;
using test::free_bed;
using test::turned;

constexpr double kR = 1.71e-3, kHeight = 3.46e-3;

Pellet at(const Vec3& position, const Quat& rotation = Quat::Identity()) {
  Pellet p;
  p.pose = {position, rotation};
  return p;
}

std::vector<double> steps(double from, double to, int n) {
  std::vector<double> v;
  for (int i = 0; i <= n; ++i) v.push_back(from + (to - from) * i / n);
  return v;
}

double sum(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0);
}

/// Area that two discs share; centres `d` apart (Weisstein, "Circle-circle intersection", MathWorld).
double shared_disc(double r, double s, double d) {
  if (d >= r + s) return 0;
  if (d <= std::abs(r - s)) return kPi * std::pow(std::min(r, s), 2);
  return r * r * std::acos((d * d + r * r - s * s) / (2 * d * r)) +
         s * s * std::acos((d * d + s * s - r * r) / (2 * d * s)) -
         0.5 * std::sqrt((-d + r + s) * (d + r - s) * (d - r + s) * (d + r + s));
}

}  // namespace

TEST(VolumeBelow, OfASphereIsItsCap) {
  const auto s = test::sphere(kR);
  for (double h = 0; h <= 2 * kR; h += kR / 7)
    EXPECT_NEAR(volume_below(*s, at({0, 0, 5e-3}), 5e-3 - kR + h), kPi * h * h * (3 * kR - h) / 3,
                1e-12 * s->volume);
}

TEST(VolumeBelow, OfAnUprightCylinderRisesLinearlyAndOfALyingOneAsTheSegmentOfItsDisc) {
  const auto c = test::cylinder(2 * kR, kHeight);
  for (double t = 0.01; t < 1; t += 0.07) {
    EXPECT_NEAR(volume_below(*c, at({0, 0, 0}), (t - 0.5) * kHeight), t * c->volume, 1e-12 * c->volume);
    const double h = (2 * t - 1) * kR;  // height of the cut over the axis
    const double segment = kR * kR * (kPi / 2 + std::asin(h / kR)) + h * std::sqrt(kR * kR - h * h);
    EXPECT_NEAR(volume_below(*c, at({0, 0, 0}, turned(kPi / 2, Vec3::UnitX())), h), segment * kHeight,
                1e-9 * c->volume);
  }
}

// A prism of 4,000 sides is the cylinder to 2 (pi / n)^2 / 3 = 4e-7; the mesh formula shares nothing with the
// other.
TEST(VolumeBelow, OfATiltedCylinderIsThatOfAFinePrism) {
  const auto c = test::cylinder(2 * kR, kHeight);
  const auto prism = test::mesh_body(test::prism(kR, kHeight / 2, 4000), c->volume, kR);
  for (const double tilt :
       {1e-9, 1e-7, 1e-5, 1e-3, 0.1, 0.5, 1.0, 1.5, kPi / 2 - 1e-5, kPi / 2 - 1e-7, kPi / 2 - 1e-9}) {
    const Pellet p = at({1e-3, 2e-3, 3e-3}, turned(0.3, Vec3::UnitZ()) * turned(tilt, Vec3::UnitX()));
    for (double z = 0; z < 6e-3; z += 0.37e-3)
      EXPECT_NEAR(volume_below(*c, p, z), volume_below(*prism, p, z), 2e-6 * c->volume)
          << "tilt " << tilt << " z " << z;
  }
}

TEST(SlabVolumes, AddUpToTheBed) {
  PackedBed bed = free_bed(
      {test::a38(), test::sphere(1e-3), test::mesh_body(test::square_cup(1e-3, 2e-3, 0.5e-3), 0, 1e-3)});
  auto cup = std::make_shared<Shape>(*bed.shapes[2]);
  cup->volume = 3e-3 * 3e-3 * 2.5e-3 - 2e-3 * 2e-3 * 2e-3;
  bed.shapes[2] = cup;
  double volume = 0;
  for (std::uint32_t i = 0; i < 90; ++i) {
    Random r(11, Stream::test, i);
    add(bed, {0, 0, r.uniform(5e-3, 50e-3)}, r.rotation(), i % 3);
    volume += bed.shapes[i % 3]->volume;
  }
  EXPECT_NEAR(sum(slab_volumes(bed, steps(0, 60e-3, 600))), volume, 1e-12 * volume);
  EXPECT_NEAR(sum(slab_volumes(bed, {0, 60e-3})), volume, 1e-12 * volume);
  // a cut through the bed: above and below add up
  EXPECT_NEAR(slab_volumes(bed, {0, 25e-3})[0] + slab_volumes(bed, {25e-3, 60e-3})[0], volume,
              1e-12 * volume);
}

TEST(RingVolumes, OfASphereOnTheAxis) {
  PackedBed bed = free_bed({test::sphere(kR)});
  add(bed, {0, 0, 0});
  const auto radii = steps(0, 2e-3, 20);
  const auto rings = ring_volumes(bed, radii, -1, 1);
  const auto within = [](double r) {  // sphere with the part outside the cylinder of radius r taken off
    return 4 * kPi / 3 * (std::pow(kR, 3) - std::pow(std::max(0.0, kR * kR - r * r), 1.5));
  };
  for (std::size_t k = 0; k < rings.size(); ++k)
    EXPECT_NEAR(rings[k], within(radii[k + 1]) - within(radii[k]), 1e-12 * bed.shapes[0]->volume);
}

TEST(RingVolumes, OfUprightCylindersAreDiscsThatTheRingsCut) {
  for (const double off : {0.0, 1e-3, 1.71e-3, 5e-3, 20e-3}) {
    PackedBed bed =
        free_bed({test::cylinder(2 * kR, kHeight),
                  test::mesh_body(test::prism(kR, kHeight / 2, 4000), kPi * kR * kR * kHeight, kR)});
    const auto radii = steps(0, 24e-3, 120);
    for (std::uint32_t shape = 0; shape < 2; ++shape) {
      bed.pellets.clear();
      add(bed, {off * 0.6, off * 0.8, 0}, Quat::Identity(), shape);
      const auto rings = ring_volumes(bed, radii, -1, 0.25 * kHeight);
      for (std::size_t k = 0; k < rings.size(); ++k) {
        const double disc = shared_disc(radii[k + 1], kR, off) - (k ? shared_disc(radii[k], kR, off) : 0);
        EXPECT_NEAR(rings[k], 0.75 * kHeight * disc, (shape ? 2e-6 : 2e-3) * bed.shapes[0]->volume)
            << off << " ring " << k;
      }
    }
  }
}

// The mesh formula is exact for the polyhedron; a fine prism makes it the reference for tilted cylinders.
TEST(RingVolumes, OfTiltedCylindersConvergeToThoseOfAFinePrism) {
  const auto c = test::cylinder(2 * kR, kHeight);
  PackedBed bed = free_bed({c}),
            prisms = free_bed({test::mesh_body(test::prism(kR, kHeight / 2, 1000), c->volume, kR)});
  for (std::uint32_t i = 0; i < 40; ++i) {
    Random r(12, Stream::test, i);
    const Vec3 position(r.uniform(-6e-3, 6e-3), r.uniform(-6e-3, 6e-3), r.uniform(-2e-3, 2e-3));
    const Quat rotation = r.rotation();
    add(bed, position, rotation);
    add(prisms, position, rotation);
  }
  const auto radii = steps(0, 9e-3, 90);
  const auto exact = ring_volumes(prisms, radii, -1.5e-3, 2e-3);
  const auto worst = [&](const RadialRule& rule) {
    const auto rings = ring_volumes(bed, radii, -1.5e-3, 2e-3, rule);
    double error = 0;
    for (std::size_t k = 0; k < rings.size(); ++k)
      error = std::max(error, std::abs(rings[k] - exact[k]) / exact[k]);
    return error;
  };
  const double coarse = worst({8, 2, 16}), usual = worst({}), fine = worst({64, 6, 200});
  std::printf(
      "radial rule: relative error of the worst ring %.1e (8 angles), %.1e (usual), %.1e (64 angles)\n",
      coarse, usual, fine);
  EXPECT_LT(usual, coarse);
  EXPECT_LT(usual, 1e-2);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(sum(ring_volumes(bed, radii, -1.5e-3, 2e-3)), sum(exact), 1e-4 * sum(exact));
}

TEST(Profiles, FromVoxelsApproachTheExactOnes) {
  const auto shape = test::a38();
  const PackedBed bed = test::spread_bed(shape, 12e-3, 60e-3, 5e-3);
  const auto rms = [](const Profile& p, double radius) {  // radius > 0: rings weigh by their area
    double squares = 0, all = 0;
    for (std::size_t k = 0; k < p.density.size(); ++k) {
      const double weight = radius > 0 ? radius - p.x_m[k] : 1;
      squares += weight * std::pow(p.density[k] - p.exact[k], 2);
      all += weight;
    }
    return std::sqrt(squares / all);
  };
  AnalysisWish wish;
  wish.to_diameters = 12;
  double axial_before = 1, radial_before = 1, bulk_last = 1;
  for (const double pitch : {0.4e-3, 0.2e-3, 0.1e-3, 0.05e-3}) {
    wish.voxel = pitch;
    const AnalysisResult r = analyse_bed(bed, wish);
    const double axial = rms(r.axial, 0), radial = rms(r.radial, 12e-3),
                 bulk = std::abs(r.bulk.packing_density - r.bulk.exact);
    std::printf("voxel %.2f mm: rms voxel - exact: axial %.1e, radial %.1e; bulk %.1e\n", 1e3 * pitch, axial,
                radial, bulk);
    EXPECT_LT(axial, axial_before);
    EXPECT_LT(radial, radial_before);
    axial_before = axial;
    radial_before = radial;
    bulk_last = bulk;
  }
  EXPECT_LT(axial_before, 0.005);
  EXPECT_LT(radial_before, 0.005);
  EXPECT_LT(bulk_last, 0.0005);
}

TEST(Bulk, OfACubicLatticeOfSpheresIsPiOverSix) {
  const double r = 1e-3;
  PackedBed bed = free_bed({test::sphere(r)});
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) add(bed, {r * (2 * x + 1), r * (2 * y + 1), r * (2 * z + 1)});
  AnalysisWish wish;
  wish.voxel = 0.05e-3;
  wish.from_diameters = 1;
  wish.to_diameters = 7;
  const AnalysisResult result = analyse_bed(bed, wish);
  EXPECT_NEAR(result.bulk.exact, kPi / 6, 1e-9);
  EXPECT_NEAR(result.bulk.packing_density, kPi / 6, 1e-3);
  EXPECT_NEAR(result.bulk.z_range_m[0], 2e-3, 1e-12);
  EXPECT_NEAR(result.bulk.z_range_m[1], 14e-3, 1e-12);
  EXPECT_NEAR(result.bulk.diameter_m, 2 * r, 1e-15);
  EXPECT_NEAR(result.bed_height_m, 16e-3, 1e-15);
  // within a layer the density of a slice at height h is pi (r^2 - h^2) / (2 r)^2: its mean square gives the
  // spread
  const double mean = kPi / 6, mean_square = kPi * kPi / 16 * 8.0 / 15;
  EXPECT_NEAR(result.bulk.axial_sd, std::sqrt(mean_square - mean * mean), 2e-3);
}

}  // namespace packbed
