// A pellet of scale s behaves like one whose shape is s times as large.
#include <gtest/gtest.h>

#include "laws/law.hpp"

namespace packbed {
namespace {

ShapePtr sphere(double size) {
  return make_sphere("ball", 2e-3 * size);
}
ShapePtr rod(double size) {
  return make_cylinder("rod", law::kDiameter * size, law::kHeight * size);
}

/// A small and a large body meet off centre on a floor and go apart again, with friction and damping.
Scene meeting(ShapePtr (*shape)(double), const std::string& kernel, bool by_scale) {
  Scene s = by_scale ? law::scene(ContainerKind::plane, shape(1))
                     : law::scene(ContainerKind::plane, {shape(0.6), shape(1.7)});
  s.kernel = kernel;
  s.gravity = Vec3(0, 0, -law::kGravity);
  law::set_contact(s, 0.5, 0.2);
  const Quat tilted(Eigen::AngleAxisd(0.4, Vec3(1, 2, 0.5).normalized()));
  PlacedPellet& small = law::place(s, {0, 0, 3e-3}, tilted);
  small.velocity = Vec3(0.9, 0.02, -0.2);
  small.scale = by_scale ? 0.6 : 1;
  PlacedPellet& large = law::place(s, {6.5e-3, 1e-3, 4.5e-3});
  large.velocity = Vec3(-0.4, 0, -0.3);
  large.scale = by_scale ? 1.7 : 1;
  if (!by_scale) large.kind = 1;
  return s;
}

/// `rounding`: of the positions [m].
void expect_alike(ShapePtr (*shape)(double), const std::string& kernel, double rounding) {
  const law::Course a = law::run(meeting(shape, kernel, true), 15e-3),
                    b = law::run(meeting(shape, kernel, false), 15e-3);
  EXPECT_DOUBLE_EQ(a.result.record.time.step_s, b.result.record.time.step_s);
  const Vec3 before = meeting(shape, kernel, true).feed.placed[0].velocity;
  EXPECT_GT((a.end(0).velocity - before).norm(), 0.3) << "they never met";
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((a.end(i).pose.position - b.end(i).pose.position).norm(), rounding);
    EXPECT_LT((a.end(i).velocity - b.end(i).velocity).norm(), 1e3 * rounding);
    EXPECT_LT((a.end(i).spin - b.end(i).spin).norm(), 1e6 * rounding);
  }
  EXPECT_EQ(a.end(0).scale, 0.6);
  EXPECT_EQ(b.end(0).scale, 1);
  EXPECT_NEAR(a.result.record.energy.input, b.result.record.energy.input,
              1e-12 * a.result.record.energy.input);
}

TEST(Scale, IsTheSizeOfASphere) {
  expect_alike(sphere, "sphere", 1e-9);
}
TEST(Scale, IsTheSizeOfACylinder) {
  expect_alike(rod, "cylinder", 1e-9);
}
TEST(Scale, IsTheSizeOfAMesh) {
  expect_alike(rod, "field", 1e-7);  // its tables are of single precision
}

TEST(Scale, StiffnessAndStepFollowTheLargestAndTheSmallest) {
  Scene s = law::scene(ContainerKind::plane, sphere(1));
  s.pellet_contact.stiffness = s.wall_contact.stiffness = 0;
  law::place(s, {0, 0, 10e-3}).velocity = Vec3(0, 0, -1);
  const double step = law::run(s, 1e-3).result.record.time.step_s;
  s.feed.placed[0].scale = 2;  // k goes like the scale, m like its cube: t ~ sqrt(m / k) like the scale
  EXPECT_NEAR(law::run(s, 1e-3).result.record.time.step_s / step, 2, 1e-9);
  law::place(s, {50e-3, 0, 10e-3}).scale = 0.5;  // k stays, the mass of the lightest is 64 times less
  EXPECT_NEAR(law::run(s, 1e-3).result.record.time.step_s / step, 0.25, 1e-9);
}

}  // namespace
}  // namespace packbed
