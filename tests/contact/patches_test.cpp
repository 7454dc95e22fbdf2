// Pairs taken apart into patches: the energy is that of the pair, opposing normals stay apart, patches go on
// from step to step, and the list of near points changes nothing.
#include "contact/patches.hpp"

#include <gtest/gtest.h>

#include "../shapes.hpp"
#include "math/random.hpp"
#include "shape/shape.hpp"

namespace packbed {
namespace {

const FieldBody& ring() {
  static const FieldBody body = make_field_body(*make_ring("ring", 6e-3, 4.6e-3, 4e-3));
  return body;
}
const FieldBody& rod() {
  static const FieldBody body = make_field_body(*test::a38());
  return body;
}
/// A rod that is a little too wide for the hole of the ring.
const FieldBody& plug() {
  static const FieldBody body = make_field_body(*test::cylinder(4.62e-3, 6e-3));
  return body;
}

PatchTouches touch(const FieldPellet& a, const FieldPellet& b, std::span<const PatchMark> marks = {}) {
  NearPoints near;
  PatchTouches out;
  touch_patches(a, b, 0, marks, near, out);
  return out;
}

std::vector<PatchMark> marks_of(const PatchTouches& t) {
  std::vector<PatchMark> marks;
  for (std::size_t k = 0; k < t.count; ++k)
    marks.push_back({t.touch[k].point, t.touch[k].gradient.normalized()});
  return marks;
}

TEST(Patches, AddUpToTheEnergyAndForcesOfThePair) {
  int several = 0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    Random random(1, Stream::test, i);
    const FieldPellet a{&ring(), {Vec3::Zero(), random.rotation()}},
        b{&ring(), {random.uniform(3e-3, 6e-3) * random.on_sphere(), random.rotation()}};
    const Touch whole = touch_field(a, b);
    const PatchTouches parts = touch(a, b);
    ASSERT_EQ(parts.count > 0, whole.delta > 0);
    if (parts.count == 0) continue;
    several += parts.count > 1;
    double energy = 0;
    Vec3 force = Vec3::Zero(), torque_a = Vec3::Zero(), torque_b = Vec3::Zero();
    for (std::size_t k = 0; k < parts.count; ++k) {
      const Touch& t = parts.touch[k];
      energy += t.share * t.delta * t.delta;
      force += t.share * t.delta * t.gradient;
      torque_a += t.share * t.delta * t.torque_a;
      torque_b += t.share * t.delta * t.torque_b;
    }
    EXPECT_NEAR(energy / (whole.delta * whole.delta), 1, 1e-9);
    EXPECT_NEAR(parts.delta / whole.delta, 1, 1e-9);
    EXPECT_LT((force - whole.delta * whole.gradient).norm(), 1e-9 * whole.delta);
    EXPECT_LT((torque_a - whole.delta * whole.torque_a).norm(), 1e-11 * whole.delta);
    EXPECT_LT((torque_b - whole.delta * whole.torque_b).norm(), 1e-11 * whole.delta);
  }
  EXPECT_GT(several, 30);
}

TEST(Patches, OpposingNormalsDoNotCancel) {
  // a plug that sits in a ring, pressed all round: each patch pushes on its own, and together they balance
  const FieldPellet inner{&plug(), {}}, outer{&ring(), {}};
  const PatchTouches t = touch(inner, outer);
  ASSERT_GE(t.count, 3u);
  Vec3 sum = Vec3::Zero();
  double pushes = 0;
  for (std::size_t k = 0; k < t.count; ++k) {
    sum += t.touch[k].share * t.touch[k].delta * t.touch[k].gradient;
    pushes += t.touch[k].share * t.touch[k].delta * t.touch[k].gradient.norm();
  }
  EXPECT_GT(pushes, 0.1 * t.delta);
  EXPECT_LT(sum.norm(), 0.02 * pushes);
}

TEST(Patches, GoOnFromTheNearestOfTheLastLook) {
  for (std::uint32_t i = 0; i < 60; ++i) {
    Random random(2, Stream::test, i);
    FieldPellet a{&ring(), {Vec3::Zero(), random.rotation()}};
    const FieldPellet b{&ring(), {random.uniform(3e-3, 5e-3) * random.on_sphere(), random.rotation()}};
    const PatchTouches before = touch(a, b);
    if (before.count == 0) continue;
    for (std::size_t k = 0; k < before.count; ++k)
      EXPECT_EQ(before.mark[k], kMostPatches) << "none was given";
    const std::vector<PatchMark> marks = marks_of(before);
    a.pose.position += 1e-8 * random.on_sphere();
    const PatchTouches after = touch(a, b, marks);
    std::size_t known = 0;
    for (std::size_t k = 0; k < after.count; ++k) {
      if (after.mark[k] == kMostPatches) continue;
      ++known;
      double nearest = 1e300;
      for (const PatchMark& m : marks) nearest = std::min(nearest, (m.centre - after.touch[k].point).norm());
      EXPECT_LT(nearest, 1.5 * ring().size) << "within the size of the bodies, and of a cluster of points";
    }
    EXPECT_GE(known + 1, before.count) << "patches that press stay";
  }
}

TEST(Patches, TheListOfNearPointsChangesNothing) {
  // bodies that slide past and into each other: with a list that is kept, and with a fresh one at each look
  for (std::uint32_t i = 0; i < 2; ++i) {
    Random random(3, Stream::test, i);
    FieldPellet a{i % 2 ? &ring() : &rod(), {Vec3::Zero(), random.rotation()}};
    const FieldPellet b{&ring(), {Vec3(5.6e-3, 0, 0), random.rotation()}};
    NearPoints kept;
    std::vector<PatchMark> marks;
    double travelled = 0, look_at = 0;
    int touching = 0, lists = 0;
    for (int k = 0; k < 2000; ++k) {
      const double way = 1.2e-6, turn = 2e-4;  // the farthest point goes no more than way + turn 4 mm
      a.pose.position.x() += k < 1000 ? 1.8 * way : -1.8 * way;
      a.pose.rotation = Quat(Eigen::AngleAxisd(turn, Vec3(0.6, 0.8, 0))) * a.pose.rotation;
      travelled += 1.8 * way + turn * 4e-3;
      const PatchTouches fresh = touch(a, b, marks);
      if (travelled < look_at) {
        ASSERT_EQ(fresh.count, 0u) << "a touch was skipped at step " << k;
        continue;
      }
      PatchTouches followed;
      touch_patches(a, b, travelled, marks, kept, followed);
      lists += kept.looks == 1;
      ASSERT_EQ(followed.count, fresh.count) << k;
      for (std::size_t p = 0; p < fresh.count; ++p) {
        ASSERT_EQ(followed.touch[p].delta, fresh.touch[p].delta);
        ASSERT_EQ(followed.touch[p].gradient, fresh.touch[p].gradient);
        ASSERT_EQ(followed.touch[p].torque_b, fresh.touch[p].torque_b);
      }
      if (followed.count == 0) look_at = travelled + followed.gap;
      touching += followed.count > 0;
      marks = marks_of(followed);
    }
    EXPECT_GT(touching, 100);
    EXPECT_LT(lists, 1000);
  }
}

}  // namespace
}  // namespace packbed
