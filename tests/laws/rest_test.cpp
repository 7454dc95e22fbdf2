// What stands must stand: no drift, no creep, forces in balance.
#include <gtest/gtest.h>

#include "laws/law.hpp"

namespace packbed {
namespace {

using namespace law;

/// `n` A38 standing on each other round one axis.
Scene stack(int n) {
  Scene s = scene(ContainerKind::plane, a38());
  set_contact(s, 0.5, 0.3);
  s.gravity = {0, 0, -kGravity};
  for (int i = 0; i < n; ++i) place(s, {0, 0, (i + 0.5) * kHeight});
  return s;
}

// A step of 35 us (contact of 1 kN/m) needs 1.7 million steps.
TEST(LongRest, OfAFlatCapIsWithoutDriftForAMinute) {
  Scene s = stack(1);
  s.wall_contact.stiffness = 1e3;
  const Course r = run(s, 60, 1);
  const double weight = mass(s, r.end()) * kGravity;
  const Pose& settled = r.frames[2].pellets[0].pose;  // after two seconds
  for (std::size_t f = 2; f < r.frames.size(); ++f) {
    const Pellet& p = r.frames[f].pellets[0];
    EXPECT_LT((p.pose.position - settled.position).norm(), 1e-3 * kDiameter) << r.frames[f].time;
    EXPECT_LT(p.pose.rotation.angularDistance(settled.rotation), 1e-3) << r.frames[f].time;
    EXPECT_LT(kinetic(s, p), 1e-9 * weight * kDiameter) << r.frames[f].time;
  }
  EXPECT_NEAR(r.result.record.wall.base_force_N / weight, 1, 1e-6);
}

TEST(Stack, OfTenCoaxialCylindersStands) {
  const Course r = run(stack(10), 2, 0.1);
  const double weight = mass(stack(1), r.end()) * kGravity;
  for (std::size_t i = 0; i < 10; ++i) {
    const Pellet &middle = r.frames[r.frames.size() / 2].pellets[i], &p = r.end(i);
    EXPECT_LT((p.pose.position - middle.pose.position).norm(), 1e-3 * kDiameter) << i;
    EXPECT_LT(p.pose.position.head<2>().norm(), 1e-2 * kDiameter) << i;
    EXPECT_GT((p.pose.rotation * Vec3::UnitZ()).z(), std::cos(0.01)) << i;
    // each joint is pressed in by what stands on it: at most the whole weight over the softest flat stiffness
    EXPECT_NEAR(p.pose.position.z(), (static_cast<double>(i) + 0.5) * kHeight, 0.01 * kHeight) << i;
  }
  EXPECT_NEAR(r.result.record.wall.base_force_N / (10 * weight), 1, 1e-3);
}

// Two balls that are placed k delta^2 / 2 deep in each other part with that energy, and the ledger knows it.
TEST(PlacedInEachOther, BodiesPartWithTheEnergyOfTheirOverlap) {
  const double radius = 2e-3, overlap = 0.02e-3;
  Scene s = scene(ContainerKind::none, make_sphere("ball", radius));
  set_contact(s, 0, 0);
  place(s, {0, 0, 0});
  place(s, {2 * radius - overlap, 0, 0});
  const Course r = run(s, 2e-3);
  const double energy = 0.5 * s.pellet_contact.stiffness * overlap * overlap;
  EXPECT_NEAR(kinetic(s, r.end(0)) + kinetic(s, r.end(1)), energy, 0.01 * energy);
  EXPECT_NEAR(r.result.record.energy.input, energy, 1e-6 * energy);
  EXPECT_LT(r.result.record.energy.ledger_error, 0.01);
}

// One ball in the hollow of three fixed ones that touch each other: each carries W / sqrt(6), along the line
// of centres.
TEST(ThreeFixedBalls, CarryAFourthWithItsWeightOverRootSix) {
  const double radius = 2e-3, ring = 2 * radius / std::sqrt(3), height = 2 * radius * std::sqrt(2.0 / 3);
  Scene s = scene(ContainerKind::none, make_sphere("ball", radius));
  set_contact(s, 0, 0.3);
  s.gravity = {0, 0, -kGravity};
  for (int i = 0; i < 3; ++i)
    place(s, {ring * std::cos(2 * kPi * i / 3), ring * std::sin(2 * kPi * i / 3), 0}).fixed = true;
  place(s, {0, 0, height});
  const Course r = run(s, 0.5);
  const double weight = mass(s, r.end(3)) * kGravity;
  Vec3 sum = Vec3::Zero();
  int carried = 0;
  for (const Contact& c : r.result.bed.contacts) {
    if (c.a != 3 && c.b != 3) continue;
    ++carried;
    EXPECT_NEAR(c.force.norm() / weight, 1 / std::sqrt(6), 1e-3);
    sum += c.a == 3 ? c.force : Vec3(-c.force);
  }
  EXPECT_EQ(carried, 3);
  EXPECT_LT((sum / weight - Vec3::UnitZ()).norm(), 1e-3);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(r.end(i).pose.position, r.frames.front().pellets[i].pose.position);  // fixed is fixed
}

/// A small pour into a tube, until it is at rest.
Scene pour(const ShapePtr& shape, int count) {
  Scene s = scene(ContainerKind::tube, shape);
  s.container = make_tube("tube", 16e-3, 60e-3);
  set_contact(s, 0.5, 0.4);
  s.pellet_contact.stiffness = s.wall_contact.stiffness = 3e3;
  s.gravity = {0, 0, -kGravity};
  s.feed.kind = FeedKind::layers;
  s.feed.count = count;
  s.feed.per_layer = 8;
  s.feed.drop_height = 40e-3;
  s.feed.interval = 0.05;
  s.stepping.rest_force = 0.01;
  return s;
}

// Floor and wall carry the bed, to a thousandth.
TEST(Bed, AtRestIsCarriedByFloorAndWall) {
  for (const ShapePtr& shape : {a38(), make_sphere("ball", 1.8e-3)}) {
    const Scene s = pour(shape, 60);
    const PackResult r = pack_mesh(s, {});
    EXPECT_TRUE(r.record.at_rest);
    EXPECT_EQ(r.record.pellets.inside, 60);
    const double weight = 60 * kDensity * shape->volume * kGravity;
    EXPECT_NEAR(r.record.wall.weight_N / weight, 1, 1e-9);
    EXPECT_NEAR((r.record.wall.base_force_N + r.record.wall.side_shear_N) / weight, 1, 5e-3) << shape->name;
    EXPECT_LT(r.record.energy.ledger_error, 0.01) << shape->name;
    EXPECT_TRUE(r.record.audit_passed()) << shape->name;
    Vec3 carried = Vec3::Zero();
    for (const Contact& c : r.bed.contacts)
      if (c.b == kContainer) carried += c.force;
    EXPECT_LT((carried / weight - Vec3::UnitZ()).norm(), 1e-2) << shape->name;
  }
}

}  // namespace
}  // namespace packbed
