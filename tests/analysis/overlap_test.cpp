// Overlap measured from geometry, against closed forms.
#include "analysis/overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/penetration.hpp"
#include "make_bed.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

using test::add;
using test::free_bed;
using test::tube_bed;
using test::turned;

constexpr double kR = 1.71e-3, kH = 1.73e-3;

/// Depth of the only pair [m]; 0 for none.
double depth(const PackedBed& bed) {
  const auto overlaps = find_overlaps(bed);
  EXPECT_LE(overlaps.size(), 1U);
  return overlaps.empty() ? 0 : overlaps[0].depth;
}

Quat lying_along_y() {
  return turned(kPi / 2, Vec3::UnitX());
}
Quat lying_along_x() {
  return turned(kPi / 2, Vec3::UnitY());
}

/// As a mesh, so that the same closed forms hold the other path.
std::shared_ptr<Shape> block(const Vec3& half) {
  return test::mesh_body(test::box(half), 8 * half.prod(), 2 * half.minCoeff());
}

}  // namespace

TEST(Overlap, OfSpheresIsTheSumOfRadiiLessTheDistanceAndSharesALens) {
  PackedBed bed = free_bed({test::sphere(1e-3), test::sphere(2e-3)});
  add(bed, {0, 0, 0}, Quat::Identity(), 0);
  add(bed, {1.5e-3, 2e-3, 0}, Quat::Identity(), 1);
  const auto overlaps = find_overlaps(bed);
  ASSERT_EQ(overlaps.size(), 1U);
  const double r = 1e-3, s = 2e-3, d = 2.5e-3;
  EXPECT_NEAR(overlaps[0].depth, r + s - d, 1e-15);
  EXPECT_NEAR(overlaps[0].fraction, (r + s - d) / (2 * r), 1e-12);
  const double lens =
      kPi * std::pow(r + s - d, 2) * (d * d + 2 * d * (r + s) - 3 * (r - s) * (r - s)) / (12 * d);
  EXPECT_NEAR(overlaps[0].volume, lens, 0.03 * lens);
  EXPECT_TRUE(find_overlaps(free_bed({test::sphere(1e-3)})).empty());
}

TEST(Overlap, OfCoaxialCylindersIsTheirSharedHeight) {
  PackedBed bed = free_bed({test::cylinder(2 * kR, 2 * kH)});
  for (const double d : {1e-7, 1e-5, 1e-4}) {
    bed.pellets.clear();
    add(bed, {0, 0, 0});
    add(bed, {0.2e-3, 0, 2 * kH - d});
    EXPECT_NEAR(depth(bed), d, 1e-11);
  }
  bed.pellets[1].pose.position = {0, 0, 2 * kH - 1e-4};
  const double shared = kPi * kR * kR * 1e-4;
  EXPECT_NEAR(find_overlaps(bed)[0].volume, shared, 0.03 * shared);
  bed.pellets[1].pose.position.z() = 2 * kH + 1e-8;
  EXPECT_EQ(depth(bed), 0);
}

TEST(Overlap, OfParallelAndOfCrossedCylindersIsTheDiameterLessTheDistanceOfTheAxes) {
  PackedBed bed = free_bed({test::cylinder(2 * kR, 2 * kH)});
  for (const double d : {1e-7, 1e-5, 1e-4}) {
    bed.pellets.clear();
    add(bed, {0, 0, 0});
    add(bed, {(2 * kR - d) * 0.6, (2 * kR - d) * 0.8, 0.5e-3});
    EXPECT_NEAR(depth(bed), d, 1e-11);
    for (const double angle : {0.01, 0.5, kPi / 2}) {
      bed.pellets.clear();
      add(bed, {0, 0, 0}, lying_along_x());
      add(bed, {0, 0, 2 * kR - d}, turned(angle, Vec3::UnitZ()) * lying_along_x());
      EXPECT_NEAR(depth(bed), d, 1e-11) << angle;
    }
  }
}

TEST(Overlap, OfACornerInAFaceIsItsDepth) {
  PackedBed bed = free_bed({test::cylinder(2 * kR, 2 * kH), block({2e-3, 2e-3, 1e-3})});
  for (const double tilt : {0.001, 0.3, 0.8, 1.4}) {  // the rim of a tilted cylinder in the top of a block
    bed.pellets.clear();
    const double d = 2e-5, low = kR * std::sin(tilt) + kH * std::cos(tilt);
    add(bed, {0, 0, 1e-3 + low - d}, turned(tilt, Vec3::UnitX()), 0);
    add(bed, {0, 0, 0}, Quat::Identity(), 1);
    EXPECT_NEAR(depth(bed), d, 1e-11) << tilt;
  }
}

TEST(Overlap, OfBlocksIsTheSmallestOfTheirSharedWidths) {
  PackedBed bed = free_bed({block({1e-3, 1.5e-3, 2e-3})});
  add(bed, {0, 0, 0});
  add(bed, {1.9e-3, 2.95e-3, 3.8e-3});
  EXPECT_NEAR(depth(bed), 0.05e-3, 1e-12);  // along y
  const double shared = 0.1e-3 * 0.05e-3 * 0.2e-3;
  EXPECT_NEAR(find_overlaps(bed)[0].volume, shared, 0.2 * shared);  // a long thin overlap: the roughest case
}

// However two bodies lie, moving one by the depth along the normal parts them, and by less than the depth
// along any of many directions does not.
TEST(Overlap, IsTheShortestPushThatParts) {
  const auto cylinder = test::cylinder(2 * kR, 2 * kH);
  const std::vector<ShapePtr> shapes{cylinder, block({1e-3, 1.2e-3, 1.9e-3}), test::sphere(kR)};
  std::vector<SolidShape> solids;
  for (const ShapePtr& s : shapes) solids.emplace_back(s);
  int touching = 0;
  for (std::uint32_t i = 0; i < 400; ++i) {
    Random r(41, Stream::test, i);
    Pellet p, q;
    p.pose = {Vec3::Zero(), r.rotation()};
    q.pose = {r.on_sphere() * r.uniform(2e-3, 4e-3), r.rotation()};
    const SolidShape &s = solids[i % 3], &t = solids[i / 3 % 3];
    const auto found = penetration(Body(s, p), Body(t, q));
    if (!found) {
      for (int k = 0; k < 20000; ++k) {  // apart: no point is in both
        const Vec3 x = q.pose.position * r.uniform() + 2e-3 * r.uniform() * r.on_sphere();
        ASSERT_LT(std::min(Body(s, p).depth(x), Body(t, q).depth(x)), 1e-9) << i;
      }
      continue;
    }
    ++touching;
    Pellet pushed = q;
    pushed.pose.position += found->normal * (found->depth * (1 + 1e-6) + 1e-12);
    EXPECT_FALSE(penetration(Body(s, p), Body(t, pushed)).has_value()) << i;
    for (int k = 0; k < 2000; ++k) {
      const Vec3 n = r.on_sphere();
      ASSERT_GE(n.dot(Body(s, p).furthest(n)) - n.dot(Body(t, q).furthest(-n)), found->depth * (1 - 1e-6))
          << i;
    }
    EXPECT_GE(found->uncertainty, -1e-12);
    EXPECT_LT(found->uncertainty, 1e-8 * kR) << i;
  }
  EXPECT_GT(touching, 50);
  EXPECT_LT(touching, 350);
}

TEST(Overlap, WithATubeIsHowFarTheRimReachesBeyond) {
  const double radius = 22.25e-3;
  PackedBed bed = tube_bed({test::cylinder(2 * kR, 2 * kH), test::sphere(kR)}, radius);
  add(bed, {0, 0, 10e-3}, Quat::Identity(), 1);
  bed.pellets[0].pose.position = {0.6 * (radius - kR + 1e-5), 0.8 * (radius - kR + 1e-5), 10e-3};
  EXPECT_NEAR(depth(bed), 1e-5, 1e-15);
  bed.pellets.clear();  // upright: its side
  add(bed, {radius - kR + 2e-5, 0, 10e-3});
  EXPECT_NEAR(depth(bed), 2e-5, 1e-12);
  // lying along y at x: a rim is a level disc's edge at y = kH: its corner is at (x + 0, kH) seen from above
  bed.pellets.clear();
  const double x = std::sqrt(radius * radius - kH * kH) - kR + 3e-5;
  add(bed, {x, 0, 10e-3}, lying_along_y());
  EXPECT_NEAR(depth(bed), std::hypot(x + kR, kH) - radius, 1e-12);
  // lying along x: the cap's horizontal diameter has its ends at y = +- kR
  bed.pellets.clear();
  const double inwards = std::sqrt(radius * radius - kR * kR) - kH + 4e-5;
  add(bed, {inwards, 0, 10e-3}, lying_along_x());
  EXPECT_NEAR(depth(bed), std::hypot(inwards + kH, kR) - radius, 1e-12);
}

TEST(Overlap, OfATiltedRimWithATubeIsTheLargestOverAllItsPoints) {
  const double radius = 5e-3;
  const auto shape = test::cylinder(2 * kR, 2 * kH);
  for (std::uint32_t i = 0; i < 200; ++i) {
    Random r(42, Stream::test, i);
    Pellet p;
    p.pose = {Vec3(r.uniform(-3e-3, 3e-3), r.uniform(-3e-3, 3e-3), 0), r.rotation()};
    double far = 0;
    for (int k = 0; k < 20000; ++k) {
      const double t = 2 * kPi * k / 20000;
      for (const double h : {-kH, kH})
        far = std::max(far, p.pose.to_world({kR * std::cos(t), kR * std::sin(t), h}).head<2>().norm());
    }
    EXPECT_NEAR(reach_from_axis(*shape, p), far, 1e-6 * radius) << i;  // the step leaves 1e-7 of the radius
    EXPECT_GE(reach_from_axis(*shape, p), far - 1e-15) << i;
  }
}

TEST(Overlap, WithTheFloorIsHowFarThePelletReachesBelow) {
  PackedBed bed = tube_bed({test::cylinder(2 * kR, 2 * kH)}, 22.25e-3);
  const double tilt = 0.4, low = kR * std::sin(tilt) + kH * std::cos(tilt);
  add(bed, {0, 0, low - 1e-5}, turned(tilt, Vec3::UnitX()));
  EXPECT_NEAR(depth(bed), 1e-5, 1e-15);
  const auto overlaps = find_overlaps(bed);
  EXPECT_EQ(overlaps[0].b, kContainer);
  bed.container.kind = ContainerKind::plane;
  EXPECT_NEAR(depth(bed), 1e-5, 1e-15);
  bed.container.kind = ContainerKind::none;
  EXPECT_EQ(depth(bed), 0);
}

TEST(Overlap, WithAContainerMeshIsFoundFromPointsOfBoth) {
  PackedBed bed = free_bed({block({1e-3, 1e-3, 1e-3})});
  bed.container.kind = ContainerKind::mesh;
  bed.container.surface = test::square_cup(5e-3, 10e-3, 1e-3);
  add(bed, {0, 0, 1e-3 - 2e-5});
  add(bed, {4e-3 + 3e-5, 0, 5e-3});
  add(bed, {0, 0, 5e-3});
  const auto overlaps = find_overlaps(bed);
  ASSERT_EQ(overlaps.size(), 2U);
  EXPECT_NEAR(overlaps[0].depth, 2e-5, 1e-12);
  EXPECT_NEAR(overlaps[1].depth, 3e-5, 1e-12);
}

TEST(Overlap, OfBodiesThatAreNotConvexIsFoundFromPointsOfBoth) {
  const auto cup = test::mesh_body(test::square_cup(2e-3, 4e-3, 1e-3), 1e-8, 1e-3);
  PackedBed bed = free_bed({cup, block({1e-3, 1e-3, 1e-3})});
  add(bed, {0, 0, 0}, Quat::Identity(), 0);
  add(bed, {0, 0, 1e-3 - 1e-5}, Quat::Identity(), 1);  // stands in the cup, not in its wall
  EXPECT_NEAR(depth(bed), 1e-5, 1e-12);
  bed.pellets[1].pose.position.z() = 2e-3;  // floats inside: the hull would overlap, the body does not
  EXPECT_EQ(depth(bed), 0);
}

TEST(Audit, CountsOnlyPairsThatOverlap) {
  PackedBed bed = free_bed({test::sphere(1e-3)});
  add(bed, {0, 0, 0});
  add(bed, {1.99e-3, 0, 0});
  add(bed, {0, 1.98e-3, 0});
  add(bed, {0, 0, 2.001e-3});  // near, but apart
  const OverlapAudit audit = audit_overlaps(bed, find_overlaps(bed));
  EXPECT_EQ(audit.pairs, 2);
  EXPECT_NEAR(audit.mean, (0.005 + 0.01) / 2, 1e-12);
  EXPECT_NEAR(audit.max, 0.01, 1e-12);
  EXPECT_NEAR(audit.pellet[0], 0.01, 1e-12);
  EXPECT_NEAR(audit.pellet[1], 0.005, 1e-12);
  EXPECT_EQ(audit.pellet[3], 0);
}

TEST(Audit, FindsEveryPairOfAllPairs) {
  const auto shape = test::a38();
  PackedBed bed = free_bed({shape});
  for (std::uint32_t i = 0; i < 120; ++i) {
    Random r(43, Stream::test, i);
    add(bed, {r.uniform(0, 12e-3), r.uniform(0, 12e-3), r.uniform(0, 12e-3)}, r.rotation());
  }
  const SolidShape solid(shape);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  for (std::uint32_t i = 0; i < 120; ++i)
    for (std::uint32_t j = i + 1; j < 120; ++j)
      if (penetration(Body(solid, bed.pellets[i]), Body(solid, bed.pellets[j]))) all.emplace_back(i, j);
  set_threads(1);
  const auto one = find_overlaps(bed);
  set_threads(3);
  const auto many = find_overlaps(bed);
  set_threads(1);
  ASSERT_EQ(one.size(), all.size());
  ASSERT_EQ(many.size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(std::pair(one[k].a, one[k].b), all[k]);
    EXPECT_EQ(one[k].depth, many[k].depth);
    EXPECT_EQ(one[k].volume, many[k].volume);
  }
}

}  // namespace packbed
