#include "geometry/sphere_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random.hpp"

namespace packbed {
namespace {

double ball(double r) {
  return 4 * kPi / 3 * r * r * r;
}
double cap(double r, double height) {
  return kPi * height * height * (r - height / 3);
}

TEST(SphereVolume, InABoxThatCutsOneSideIsACap) {
  const Box3 half_space(Vec3(-9, -9, -9), Vec3(0.3, 9, 9));
  for (int axis = 0; axis < 3; ++axis) {
    Box3 box = half_space;
    std::swap(box.max()[0], box.max()[axis]);
    EXPECT_NEAR(sphere_in_box(Vec3::Zero(), 1, box), ball(1) - cap(1, 0.7), 1e-10);
  }
}

TEST(SphereVolume, InOctantsThroughTheCentreIsAnEighth) {
  EXPECT_NEAR(sphere_in_box(Vec3(2, 3, 4), 1.5, {Vec3(2, 3, 4), Vec3(9, 9, 9)}), ball(1.5) / 8, 1e-12);
  EXPECT_NEAR(sphere_in_box(Vec3(2, 3, 4), 1.5, {Vec3(-9, 3, -9), Vec3(2, 9, 9)}), ball(1.5) / 4, 1e-12);
}

TEST(SphereVolume, BoxesThatFillSpaceShareTheSphereOut) {
  Random random(5, Stream::test, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 centre(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double r = random.uniform(0.2, 1.5);
    Vec3 cut;
    for (int d = 0; d < 3; ++d) cut[d] = random.uniform(-1, 1);
    double sum = 0;
    for (int octant = 0; octant < 8; ++octant) {
      Box3 box(Vec3::Constant(-4), Vec3::Constant(4));
      for (int d = 0; d < 3; ++d) (octant >> d & 1 ? box.min() : box.max())[d] = cut[d];
      const double part = sphere_in_box(centre, r, box);
      EXPECT_GE(part, -1e-12);
      sum += part;
    }
    EXPECT_NEAR(sum, ball(r), 1e-7 * ball(r));
  }
}

TEST(SphereVolume, InASmallBoxIsTheBoxAndAtItsCornersAgreesWithPoints) {
  EXPECT_NEAR(sphere_in_box(Vec3::Zero(), 1, {Vec3::Constant(-0.5), Vec3::Constant(0.5)}), 1, 1e-12);
  // corners stick out of the sphere: points of a fine lattice, standard error of so many below 2e-4
  const Box3 box(Vec3(-0.7, -0.6, 0.1), Vec3(0.8, 0.7, 0.9));
  Random random(6, Stream::test, 2);
  const int n = 400000;
  int inside = 0;
  for (int i = 0; i < n; ++i) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = random.uniform(box.min()[d], box.max()[d]);
    inside += x.norm() < 1;
  }
  const double share = static_cast<double>(inside) / n;
  EXPECT_NEAR(sphere_in_box(Vec3::Zero(), 1, box), share * box.volume(),
              4 * box.volume() * std::sqrt(share * (1 - share) / n));
}

TEST(SphereVolume, InACylinderThroughItsCentreIsTheNapkinRingLeftOut) {
  for (const double around : {0.2, 0.6, 0.99})
    EXPECT_NEAR(sphere_in_cylinder(Vec3(0, 0, 3), 1, around, -9, 9),
                ball(1) - ball(std::sqrt(1 - around * around)), 1e-12);
}

TEST(SphereVolume, InACylinderFarWiderThanItIsACapAndBehavesLikeABox) {
  const double far = 1e5;  // the wall is all but plane there
  EXPECT_NEAR(sphere_in_cylinder(Vec3(0, far - 0.4, 0), 1, far, -9, 9), ball(1) - cap(1, 0.6), 1e-4);
  EXPECT_NEAR(sphere_in_cylinder(Vec3(0, far - 0.4, 0), 1, far, 0.2, 9),
              sphere_in_box(Vec3(0, -0.4, 0), 1, {Vec3(-9, -9, 0.2), Vec3(9, 0, 9)}), 1e-4);
}

TEST(SphereVolume, SlabsOfACylinderAddUp) {
  Random random(7, Stream::test, 3);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 centre(random.uniform(0, 2), random.uniform(0, 2), 0);
    const double around = random.uniform(0.1, 3), cut = random.uniform(-0.9, 0.9);
    const double whole = sphere_in_cylinder(centre, 1, around, -2, 2);
    EXPECT_NEAR(
        sphere_in_cylinder(centre, 1, around, -2, cut) + sphere_in_cylinder(centre, 1, around, cut, 2), whole,
        1e-7);
    EXPECT_LE(whole, ball(1) + 1e-12);
  }
}

TEST(SphereVolume, LensOfTwoSpheresIsTwoCaps) {
  EXPECT_NEAR(sphere_in_sphere(1, 1, 1.8), 2 * cap(1, 0.1), 1e-14);
  EXPECT_NEAR(
      sphere_in_sphere(1, 0.5, 1.3),
      [] {
        const double x = (1.3 * 1.3 + 1 - 0.25) / 2.6;  // the common circle, from the centre of the first
        return cap(1, 1 - x) + cap(0.5, 0.5 - (1.3 - x));
      }(),
      1e-14);
  EXPECT_EQ(sphere_in_sphere(1, 0.5, 1.6), 0);
  EXPECT_DOUBLE_EQ(sphere_in_sphere(1, 0.5, 0.2), ball(0.5));
}

TEST(DiscArea, InRectanglesAndDiscs) {
  EXPECT_NEAR(disc_in_rectangle(1, Vec2(-2, -2), Vec2(2, 0)), kPi / 2, 1e-14);
  EXPECT_NEAR(disc_in_rectangle(1, Vec2(-0.5, -0.5), Vec2(0.5, 0.5)), 1, 1e-14);
  EXPECT_NEAR(disc_in_rectangle(1, Vec2(0.5, -2), Vec2(2, 2)), kPi / 3 - std::sqrt(3) / 4, 1e-14);
  EXPECT_NEAR(disc_in_disc(1, 1, 1), 2 * kPi / 3 - std::sqrt(3) / 2, 1e-14);  // the vesica
  EXPECT_NEAR(disc_in_disc(0.3, 2, 1.7), kPi * 0.09, 1e-14);
}

}  // namespace
}  // namespace packbed
