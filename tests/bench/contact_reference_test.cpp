// The slow answers of the contact bench, held against closed forms and against the kernel that they judge.
#include "bench/contact_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/contact_kernels.hpp"
#include "bench/contact_poses.hpp"
#include "bench/statistics.hpp"
#include "shape/library.hpp"

namespace packbed::bench {
namespace {

Body body_at(const SolidShape& solid, const Pose& pose) {
  Pellet pellet;
  pellet.pose = pose;
  return Body(solid, pellet);
}

// Two equal spheres: the surface of equal depth is the disc in the middle, of radius sqrt(r^2 - (d/2)^2), and
// the force the integral of the depth r - sqrt((d/2)^2 + s^2) over it.
TEST(PressureField, OfTwoSpheresIsItsClosedForm) {
  const double r = 2e-3, d = 1.96 * r;
  const SolidShape ball(make_sphere("ball", r));
  const Vec3 n = Vec3(1, 2, -0.5).normalized();
  const Body a = body_at(ball, {Vec3(0.1, 0.2, 0.3), Quat::Identity()}),
             b = body_at(ball, {Vec3(0.1, 0.2, 0.3) + d * n, Quat::Identity()});
  EXPECT_NEAR(penetration(a, b)->depth, 2 * r - d, 1e-12);
  const auto found = pressure_field(a, b, *penetration(a, b), 200);
  ASSERT_TRUE(found);
  const double c = d / 2;
  const double force = kPi * (r * (r * r - c * c) - 2.0 / 3 * (r * r * r - c * c * c));
  EXPECT_NEAR(found->force.norm() / force, 1, 5e-3);
  EXPECT_NEAR(found->force.normalized().dot(-n), 1, 1e-6);
  EXPECT_LT(distance_of_action(found->force, found->torque, a.centre()), 1e-3 * r);
  EXPECT_LT((found->point - 0.5 * (a.centre() + b.centre())).norm(), 1e-3 * r);
}

// Two boxes face to face, shifted against one another: the force is depth / 2 times the common area, in its
// middle.
TEST(PressureField, OfTwoBoxesIsItsClosedForm) {
  LibrarySizes sizes;
  sizes.size = Vec3::Constant(2e-3);
  const SolidShape box(make_box("box", sizes));
  const double depth = 2e-5;
  const Body a = body_at(box, {}), b = body_at(box, {Vec3(0.5e-3, 0, 2e-3 - depth), Quat::Identity()});
  const auto found = pressure_field(a, b, *penetration(a, b), 200);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->force.z() / (-0.5 * depth * 1.5e-3 * 2e-3), 1, 0.02);
  EXPECT_NEAR(found->point.x(), 0.25e-3, 0.02e-3);
}

// The kernel integrates arcs between exact ends, the reference adds up points: they share the law and nothing
// else. Issue bars: median 1 %, 99th percentile 10 %, nothing missed deeper than 0.5 % D.
TEST(ConvergedCylinders, AreWhatTheKernelComputes) {
  ContactSubject a38;
  for_subjects({.only = "A38", .finest = 8, .across = {8}}, [&](const ContactSubject& s) { a38 = s; });
  const ContactKernel& kernel = a38.kernels.front();
  ASSERT_EQ(kernel.name, "cylinder");
  std::vector<double> force, torque;
  for (const PosePair& p : random_pairs(a38, 60)) {
    const Touch law = kernel.law(p.a, p.b), t = kernel.touch(p.a, p.b);
    if (p.depth > 0.005 * a38.size) {
      EXPECT_GT(t.delta, 0);
    }
    if (!(law.delta > 0)) continue;
    const double scale = law.delta * law.gradient.norm();
    force.push_back((t.delta * t.gradient - law.delta * law.gradient).norm() / scale);
    torque.push_back((t.delta * t.torque_a - law.delta * law.torque_a).norm() / (scale * a38.size));
  }
  EXPECT_LT(quantile(force, 0.5), 0.01);
  EXPECT_LT(quantile(force, 0.95), 0.1);
  EXPECT_LT(quantile(torque, 0.5), 0.01);
}

}  // namespace
}  // namespace packbed::bench
