// Tubes and convex polyhedra of the field kernel, whose depth is in closed form.
#include <gtest/gtest.h>

#include "../shapes.hpp"
#include "analysis/overlap.hpp"
#include "contact/field.hpp"
#include "math/random.hpp"
#include "shape/library.hpp"

namespace packbed {
namespace {

constexpr double kD = 4.6e-3;

ShapePtr hama() {
  static const ShapePtr shape = make_ring("hama", kD, 2.5e-3, 5e-3);
  return shape;
}
ShapePtr cube() {
  static const ShapePtr shape = [] {
    LibrarySizes sizes;
    sizes.size = Vec3::Constant(4e-3);
    return make_box("cube", sizes);
  }();
  return shape;
}
ShapePtr tetrahedron() {
  static const ShapePtr shape = [] {
    LibrarySizes sizes;
    sizes.edge = 6e-3;
    return make_tetrahedron("tetrahedron", sizes);
  }();
  return shape;
}

const FieldBody& body_of(const ShapePtr& shape) {
  static std::vector<std::pair<ShapePtr, FieldBody>> made;
  made.reserve(8);
  for (const auto& [known, body] : made)
    if (known == shape) return body;
  made.emplace_back(shape, make_field_body(*shape));
  return made.back().second;
}

TEST(ExactForms, AreRecognisedAndNeedNoGrid) {
  EXPECT_EQ(hama()->kind, ShapeClass::tube);
  EXPECT_EQ(cube()->kind, ShapeClass::convex);
  EXPECT_EQ(tetrahedron()->kind, ShapeClass::convex);
  for (const ShapePtr& shape : {hama(), cube(), tetrahedron()}) EXPECT_EQ(body_of(shape).field.bytes(), 0u);
}

TEST(ExactForms, ForceAndTorquesAreTheGradientOfDelta) {
  for (const ShapePtr& shape : {hama(), cube(), tetrahedron()}) {
    const FieldBody& body = body_of(shape);
    int touching = 0;
    for (std::uint32_t i = 0; i < 60; ++i) {
      Random random(1, Stream::test, i);
      FieldPellet a{&body, {Vec3::Zero(), random.rotation()}};
      const FieldPellet b{&body, {random.uniform(3e-3, 5e-3) * random.on_sphere(), random.rotation()}};
      const Touch t = touch_field(a, b);
      if (!(t.delta > 0)) continue;
      ++touching;
      const double h = 1e-9;
      const Vec3 way = random.on_sphere(), axis = random.on_sphere();
      const auto delta = [&](double along) {
        FieldPellet moved = a;
        moved.pose.position += along * way;
        moved.pose.rotation = Quat(Eigen::AngleAxisd(along / kD, axis)) * moved.pose.rotation;
        return touch_field(moved, b).delta;
      };
      const double found = -(t.gradient.dot(way) + t.torque_a.dot(axis) / kD);
      EXPECT_NEAR((delta(h) - delta(-h)) / (2 * h), found, 1e-5);
      const Vec3 arm = a.pose.position - b.pose.position;
      EXPECT_LT((t.torque_a + t.torque_b + arm.cross(t.gradient)).norm(), 1e-11);
    }
    EXPECT_GT(touching, 15);
  }
}

TEST(ExactForms, NoWorkRoundAClosedPath) {
  for (const ShapePtr& shape : {hama(), cube(), tetrahedron()})
    for (std::uint32_t i = 0; i < 4; ++i) {
      Random random(2, Stream::test, i);
      const FieldBody& body = body_of(shape);
      const FieldPellet b{&body, {Vec3::Zero(), random.rotation()}};
      FieldPellet start{&body, {7e-3 * random.on_sphere(), random.rotation()}};
      while (touch_field(start, b).depth < 0.02 * kD) start.pose.position *= 0.998;
      const Vec3 u = 0.01 * kD * random.on_sphere(), v = 0.01 * kD * random.on_sphere();
      const int n = 4000;
      double work = 0, most = 0;
      for (int k = 0; k < n; ++k) {  // trapezoid rule on a periodic path
        const double s = 2 * kPi * k / n;
        FieldPellet a = start;
        a.pose.position += std::cos(s) * u + std::sin(s) * v;
        const Touch t = touch_field(a, b);
        work += t.delta * t.gradient.dot(std::cos(s) * v - std::sin(s) * u) * 2 * kPi / n;
        most = std::max(most, 0.5 * t.delta * t.delta);
      }
      EXPECT_LT(std::abs(work), 1e-5 * most);
    }
}

TEST(ExactForms, NoOverlapIsMissed) {
  // deeper than 0.5 % of the thickness for the meter of the audit, which knows nothing of the kernel
  for (const ShapePtr& shape : {hama(), cube(), tetrahedron()}) {
    PackedBed bed;
    bed.shapes = {shape};
    bed.densities = {1000};
    bed.container.kind = ContainerKind::none;
    const FieldBody& body = body_of(shape);
    int touching = 0;
    for (std::uint32_t i = 0; i < 200; ++i) {
      Random random(3, Stream::test, i);
      bed.pellets.assign(2, Pellet{});
      bed.pellets[1].id = 1;
      bed.pellets[0].pose.rotation = random.rotation();
      bed.pellets[1].pose = {random.uniform(3e-3, 6e-3) * random.on_sphere(), random.rotation()};
      const std::vector<Overlap> overlaps = find_overlaps(bed);
      const Touch t = touch_field({&body, bed.pellets[0].pose}, {&body, bed.pellets[1].pose});
      if (overlaps.empty() || overlaps[0].fraction < 0.005) continue;
      ++touching;
      EXPECT_GT(t.delta, 0) << shape->name << " pair " << i << " overlaps by " << overlaps[0].fraction;
    }
    EXPECT_GT(touching, 30);
  }
}

TEST(ExactForms, StiffnessIsEvenOverKindsOfTouch) {
  // on a floor, 0.5 % of the size deep, over tilts from lying to standing
  const FieldWall floor = make_field_floor();
  for (const ShapePtr& shape : {hama(), cube(), tetrahedron()}) {
    double softest = 1e300, stiffest = 0;
    for (int k = 0; k <= 200; ++k) {
      Random random(4, Stream::test, static_cast<std::uint32_t>(k));
      Quat turn = k < 10 ? Quat(Eigen::AngleAxisd(k * kPi / 18, Vec3::UnitX())) : random.rotation();
      if (k == 10 && !shape->planes.empty())
        turn = Quat::FromTwoVectors(shape->planes[0].normal, -Vec3::UnitZ());
      const FieldBody& body = body_of(shape);
      double lowest = 0;
      for (const Vec3& v : shape->kind == ShapeClass::convex ? shape->corners : shape->surface.vertices)
        lowest = std::min(lowest, (turn * v).z());
      if (shape->kind == ShapeClass::tube) {  // of the exact body
        const Vec3 axis = turn * Vec3::UnitZ();
        lowest = -shape->half_height * std::abs(axis.z()) -
                 shape->radius * std::sqrt(std::max(0.0, 1 - axis.z() * axis.z()));
      }
      const double depth = 0.005 * shape->equivalent_diameter();
      const Touch t = touch_container({&body, {Vec3(0, 0, -lowest - depth), turn}}, floor);
      const double stiffness = t.delta * t.gradient.norm() / depth;
      softest = std::min(softest, stiffness);
      stiffest = std::max(stiffest, stiffness);
    }
    std::printf("[  forms   ] stiffness of a %s on a floor: %.2f to %.2f k\n", shape->name.c_str(), softest,
                stiffest);
    EXPECT_LT(stiffest / softest, 5) << shape->name;
  }
}

TEST(ExactForms, ATubeIsHollow) {
  const FieldBody& body = body_of(hama());
  const FieldBody ball = make_field_body(*test::sphere(1.2e-3));
  EXPECT_EQ(touch_field({&ball, {}}, {&body, {}}).delta, 0) << "a ball inside, clear of the wall";
  const Touch t = touch_field({&ball, {Vec3(0.06e-3, 0, 0), Quat::Identity()}}, {&body, {}});
  EXPECT_NEAR(t.depth, 0.01e-3, 0.002e-3);
  EXPECT_NEAR(t.gradient.normalized().x(), -1, 0.02) << "pushed back by the inner side";
}

}  // namespace
}  // namespace packbed
