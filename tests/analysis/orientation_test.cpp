// Orientation of axes: classes, isotropic reference, projection.
#include "analysis/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "make_bed.hpp"

namespace packbed {

using test::add;
using test::free_bed;
using test::turned;

TEST(Orientation, RandomRotationsFollowTheIsotropicReference) {
  PackedBed bed = free_bed({test::a38()});
  const int n = 20000;
  for (std::uint32_t i = 0; i < n; ++i) add(bed, Vec3::Zero(), Random(31, Stream::test, i).rotation());
  const Orientation o = orientation(bed);
  EXPECT_NEAR(std::accumulate(o.isotropic.begin(), o.isotropic.end(), 0.0), 1, 1e-12);
  EXPECT_EQ(std::accumulate(o.count.begin(), o.count.end(), 0), n);
  double chi2 = 0;
  for (std::size_t k = 0; k < o.count.size(); ++k)
    chi2 += std::pow(o.count[k] - n * o.isotropic[k], 2) / (n * o.isotropic[k]);
  EXPECT_LT(chi2, 26.1);  // exceeded by chance once in a thousand (8 degrees of freedom)
  EXPECT_GT(chi2, 0.5);   // and hardly ever so small
}

TEST(Orientation, AnglesFallIntoTheirClasses) {
  PackedBed bed = free_bed({test::a38()});
  for (const double deg : {0.0, 5.0, 35.0, 89.0, 90.0, 145.0, 180.0})
    add(bed, Vec3::Zero(), turned(deg * kPi / 180, Vec3::UnitX()));
  const Orientation o = orientation(bed);
  EXPECT_EQ(o.count,
            (std::vector<int>{3, 0, 0, 2, 0, 0, 0, 0, 2}));  // an axis has no head: 145 is 35, 180 is 0
  EXPECT_NEAR(o.angle_deg[5], 35, 1e-9);
}

TEST(Orientation, SpheresHaveNone) {
  PackedBed bed = free_bed({test::sphere(1e-3), test::a38()});
  add(bed, Vec3::Zero(), Quat::Identity(), 0);
  add(bed, Vec3::Zero(), Quat::Identity(), 1);
  const Orientation o = orientation(bed);
  EXPECT_TRUE(std::isnan(o.angle_deg[0]));
  EXPECT_EQ(o.angle_deg[1], 0);
  EXPECT_EQ(o.lambert.size(), 1U);
  EXPECT_EQ(o.fraction[0], 1);
}

TEST(Orientation, TheAxisOfAMeshIsItsDistinctPrincipalOne) {
  const auto with_inertia = [](const Vec3& inertia) {
    Shape s;
    s.kind = ShapeClass::mesh;
    s.inertia = inertia;
    return shape_axis(s);
  };
  EXPECT_EQ(*with_inertia({2, 2, 1}), Vec3::UnitZ());
  EXPECT_EQ(*with_inertia({1, 2, 2.1}), Vec3::UnitX());
  EXPECT_EQ(*with_inertia({2, 3.5, 1.9}), Vec3::UnitY());
  EXPECT_FALSE(with_inertia({1, 1.004, 0.998}).has_value());  // a cube, nearly
}

TEST(Lambert, VerticalAxesAreTheCentreAndHorizontalOnesTheRim) {
  PackedBed bed = free_bed({test::a38()});
  add(bed, Vec3::Zero());
  add(bed, Vec3::Zero(), turned(kPi, Vec3::UnitY()));
  for (int i = 0; i < 8; ++i)
    add(bed, Vec3::Zero(), turned(i * kPi / 4, Vec3::UnitZ()) * turned(kPi / 2, Vec3::UnitX()));
  const Orientation o = orientation(bed);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(std::hypot(o.lambert[i][0], o.lambert[i][1]), 0, 1e-12);
  for (std::size_t i = 2; i < 10; ++i) EXPECT_NEAR(std::hypot(o.lambert[i][0], o.lambert[i][1]), 1, 1e-12);
}

// Isotropic axes fill the disc evenly: a circle of radius q holds the share q^2, and every sector its angle.
TEST(Lambert, EqualSolidAnglesHaveEqualAreas) {
  PackedBed bed = free_bed({test::a38()});
  const int n = 20000;
  for (std::uint32_t i = 0; i < n; ++i) add(bed, Vec3::Zero(), Random(32, Stream::test, i).rotation());
  const Orientation o = orientation(bed);
  for (const double q : {0.3, 0.5, 0.7, 0.9}) {
    int within = 0;
    for (const auto& p : o.lambert) within += std::hypot(p[0], p[1]) < q;
    EXPECT_NEAR(within, n * q * q, 4 * std::sqrt(n * q * q * (1 - q * q)));
  }
  int quadrant = 0;
  for (const auto& p : o.lambert) quadrant += p[0] > 0 && p[1] > 0;
  EXPECT_NEAR(quadrant, n / 4, 4 * std::sqrt(n * 3.0 / 16));
}

// The axis that points down and to +x is drawn at +x, seen from above.
TEST(Lambert, ShowsTheLowerEndOfTheAxis) {
  PackedBed bed = free_bed({test::a38()});
  add(bed, Vec3::Zero(), Quat::FromTwoVectors(Vec3::UnitZ(), Vec3(-1, 0, 1)));
  const Orientation o = orientation(bed);
  EXPECT_NEAR(o.lambert[0][0], std::sqrt(2.0) * std::sin(kPi / 8), 1e-12);
  EXPECT_NEAR(o.lambert[0][1], 0, 1e-12);
}

}  // namespace packbed
