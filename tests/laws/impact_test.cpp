// What an impact does: restitution, direction, spin, energy.
#include <gtest/gtest.h>

#include "contact/damping.hpp"
#include "laws/law.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

using namespace law;

/// A ball of 2 mm radius that flies straight at the floor; a frame every step.
Course head_on(double zeta, double speed, Scene& s) {
  const double radius = 2e-3;
  s = scene(ContainerKind::plane, make_sphere("ball", radius));
  set_contact(s, 0.3, zeta);
  s.stepping.step = 1e-6;  // contact time / 400
  place(s, {0, 0, radius + 1e-4}).velocity = {0, 0, -speed};
  return run(s, 2e-4 / speed * 2 + 1e-3, 1e-6);
}

class NormalImpact : public testing::TestWithParam<double> {};

TEST_P(NormalImpact, HasTheRestitutionDurationAndDepthOfTheSpringAndDashpotThatLetGo) {
  const double zeta = GetParam(), speed = 0.5;
  Scene s;
  const Course r = head_on(zeta, speed, s);
  const double w0 = std::sqrt(1e4 / mass(s, r.end())), sine = std::sqrt(1 - zeta * zeta);
  double deepest = 0, begin = -1, end = -1;
  for (std::size_t f = 1; f < r.frames.size(); ++f) {
    const Pellet &before = r.frames[f - 1].pellets[0], &now = r.frames[f].pellets[0];
    EXPECT_GE(now.velocity.z() - before.velocity.z(), -1e-12) << "the contact pulls";
    deepest = std::max(deepest, 2e-3 - now.pose.position.z());
    if (now.velocity.z() - before.velocity.z() > 1e-9) {
      if (begin < 0) begin = r.frames[f - 1].time;
      end = r.frames[f].time;
    }
  }
  EXPECT_NEAR(r.end().velocity.z() / speed, restitution(zeta), 0.005);
  EXPECT_LT(r.end().velocity.head<2>().norm(), 1e-12);
  EXPECT_LT(r.end().spin.norm(), 1e-9);
  const double duration = zeta > 0 ? -std::log(restitution(zeta)) / zeta : kPi;  // e = exp(-zeta w0 t)
  EXPECT_NEAR(w0 * (end - begin), duration, 0.02);
  const double depth = zeta > 0 ? std::exp(-zeta / sine * std::atan(sine / zeta)) : 1;
  EXPECT_NEAR(w0 * deepest / speed, depth, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Damping, NormalImpact, testing::Values(0.0, 0.05, 0.1, 0.2, 0.3, 0.5),
                         [](const auto& of) {
                           return "Zeta" + std::to_string(static_cast<int>(100 * of.param));
                         });

TEST(NormalImpactSpeed, DoesNotChangeTheRestitutionOfALinearSpring) {
  Scene s;
  for (const double speed : {0.01, 0.1, 1.0})
    EXPECT_NEAR(head_on(0.2, speed, s).end().velocity.z() / speed, restitution(0.2), 0.005) << speed;
}

// The masses at the contact are those of both bodies: two balls of different mass part at e times their
// speed.
TEST(NormalImpact, OfTwoPelletsHasTheSameRestitution) {
  Scene s = scene(ContainerKind::none, {make_sphere("small", 1e-3), make_sphere("large", 3e-3)});
  set_contact(s, 0.3, 0.2);
  s.stepping.steps_per_contact = 100;
  place(s, {-1.1e-3, 0, 0}).velocity = {1, 0, 0};
  PlacedPellet& large = place(s, {3.1e-3, 0, 0});
  large.kind = 1;
  large.velocity = {-0.2, 0, 0};
  const Course r = run(s, 0.003);
  EXPECT_NEAR((r.end(1).velocity.x() - r.end(0).velocity.x()) / 1.2, restitution(0.2), 0.005);
}

// Heights of a bouncing ball fall by e^2 at each bounce.
TEST(BouncingBall, ComesBackToESquaredOfItsHeight) {
  const double radius = 2e-3, e = 0.8, drop = 0.05;
  Scene s = scene(ContainerKind::plane, make_sphere("ball", radius));
  set_contact(s, 0.3, damping(e));
  s.gravity = {0, 0, -kGravity};
  s.stepping.steps_per_contact = 100;
  place(s, {0, 0, radius + drop});
  const double fall = std::sqrt(2 * drop / kGravity);
  const Course r = run(s, fall * (1 + 2 * e + 2 * e * e), 1e-4);
  const auto highest = [&](double from, double to) {
    double height = 0;
    for (const Frame& f : r.frames)
      if (f.time > from * fall && f.time < to * fall)
        height = std::max(height, f.pellets[0].pose.position.z() - radius);
    return height;
  };
  EXPECT_NEAR(highest(1 + 0.5 * e, 1 + 1.5 * e) / drop, e * e, 0.01);
  EXPECT_NEAR(highest(1 + 2 * e + 0.5 * e * e, 1 + 2 * e + 1.5 * e * e) / drop, e * e * e * e, 0.01);
}

class ObliqueImpact : public testing::TestWithParam<double> {};

// A ball that slides all through the impact: e_t = 1 - mu (1 + e) / tan(theta), omega = 2.5 mu (1 + e) v
// cos(theta) / r (Chung & Ooi 2011, test 4: radius 2.5 mm, 3.9 m/s, mu 0.092, e 0.98; theta from the normal).
TEST_P(ObliqueImpact, SlidesByCoulombsLaw) {
  const double theta = GetParam() * kPi / 180, speed = 3.9, radius = 2.5e-3, mu = 0.092, e = 0.98;
  ASSERT_GT(std::tan(theta), 3.5 * mu * (1 + e));  // else it sticks
  Scene s = scene(ContainerKind::plane, make_sphere("ball", radius));
  set_contact(s, mu, damping(e));
  s.wall_contact.stiffness = 1e6;
  s.stepping.steps_per_contact = 100;
  place(s, {0, 0, radius + 1e-5}).velocity = speed * Vec3(std::sin(theta), 0, -std::cos(theta));
  const Course r = run(s, 5e-4);
  EXPECT_NEAR(r.end().velocity.z(), e * speed * std::cos(theta), 0.01 * speed * std::cos(theta));
  const double omega = 2.5 * mu * (1 + e) * speed * std::cos(theta) / radius;
  EXPECT_NEAR(r.end().spin.y() / omega, 1, 0.01);
  EXPECT_NEAR(r.end().velocity.x() / (speed * std::sin(theta)), 1 - mu * (1 + e) / std::tan(theta), 0.01);
  EXPECT_NEAR(r.end().spin.x() / omega, 0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Angle, ObliqueImpact, testing::Values(40.0, 50.0, 60.0, 70.0, 80.0),
                         [](const auto& of) {
                           return std::to_string(static_cast<int>(of.param)) + "Degrees";
                         });

class RimImpact : public testing::TestWithParam<std::tuple<double, double>> {};

// A cylinder that drops on its rim without friction: the impulse P = (1 + e) v / (1 / m + b^2 / I) at the
// lever b of the rim's lowest point (rigid-body impulse; validated against DEM by Kodam et al. 2010).
TEST_P(RimImpact, TurnsDropIntoSpinByTheLeverOfTheRim) {
  const auto [degrees, e] = GetParam();
  const double tilt = degrees * kPi / 180, speed = 0.2, r = kDiameter / 2, h = kHeight / 2;
  Scene s = scene(ContainerKind::plane, a38());
  set_contact(s, 0, e < 1 ? damping(e) : 0);
  s.stepping.steps_per_contact = 60;
  const double bottom = h * std::cos(tilt) + r * std::sin(tilt);  // lowest point below the centre
  place(s, {0, 0, bottom + 2e-6}, Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY()))).velocity = {0, 0, -speed};
  const Course course = run(s, 4e-4, 4e-6);  // the first contact is over, the other end has not come down
  const double m = mass(s, course.end()), inertia = kDensity * s.pellets[0].shape->inertia.x();
  const double lever = r * std::cos(tilt) - h * std::sin(tilt);  // of the lowest point about y, signed
  const double impulse = (1 + e) * speed / (1 / m + lever * lever / inertia);
  EXPECT_NEAR(course.end().velocity.z() / speed, impulse / m / speed - 1, 0.03);
  EXPECT_NEAR(std::abs(course.end().spin.y()) * kDiameter / speed,
              impulse * std::abs(lever) / inertia * kDiameter / speed, 0.03);
  EXPECT_NEAR(course.end().velocity.head<2>().norm() / speed, 0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Tilt, RimImpact,
                         testing::Combine(testing::Values(15.0, 30.0, 60.0, 75.0),
                                          testing::Values(1.0, 0.5)));

/// Root mean square of the relative change of energy over `n` elastic, frictionless impacts in random poses.
double energy_error(ContainerKind container, const ShapePtr& shape, double steps_per_contact) {
  constexpr int n = 200;
  Scene s = scene(container, shape);
  set_contact(s, 0, 0);
  s.stepping.steps_per_contact = steps_per_contact;
  const double reach = shape->bounding_radius;
  for (int i = 0; i < n; ++i) {  // far from each other: pairs in free space, single pellets over a floor
    Random random(5, Stream::test, static_cast<std::uint32_t>(i));
    const Vec3 place_(16 * reach * (i % 20), 16 * reach * (i / 20), 0);
    const double speed = random.uniform(0.3, 1.0);
    if (container == ContainerKind::plane) {
      place(s, place_ + Vec3(0, 0, reach * 1.01), random.rotation()).velocity = {0, 0, -speed};
    } else {
      const Vec3 along = random.on_sphere(), aside = random.on_sphere().cross(along);
      place(s, place_ + 1.01 * reach * along + 0.5 * reach * aside, random.rotation()).velocity =
          -0.5 * speed * along;
      place(s, place_ - 1.01 * reach * along, random.rotation()).velocity = 0.5 * speed * along;
    }
  }
  const Course r = run(s, 0.02);
  EXPECT_EQ(r.frames.back().elastic, 0) << "some have not parted";
  double squares = 0;
  int hits = 0;
  const std::size_t group = container == ContainerKind::plane ? 1 : 2;
  for (std::size_t i = 0; i < s.feed.placed.size(); i += group) {
    double before = 0, after = 0, change = 0;
    for (std::size_t j = i; j < i + group; ++j) {
      const Pellet &p = r.frames.front().pellets[j], &q = r.end(j);
      before += kinetic(s, p);
      after += kinetic(s, q);
      change += (p.velocity - q.velocity).norm();
    }
    if (change > 1e-6) ++hits;
    squares += (after / before - 1) * (after / before - 1);
  }
  EXPECT_GT(hits, n / 2);
  return std::sqrt(squares / hits);
}

constexpr const char* kBodies[] = {"Spheres", "Cylinders", "Tubes"};

class ElasticImpacts : public testing::TestWithParam<std::tuple<ContainerKind, int>> {};

TEST_P(ElasticImpacts, KeepTheirEnergyBetterWithShorterSteps) {
  const auto [container, body] = GetParam();
  const ShapePtr shapes[] = {make_sphere("ball", 2e-3), a38(), make_ring("ring", 4.6e-3, 2.5e-3, 5e-3)};
  const ShapePtr& shape = shapes[body];
  const double at20 = energy_error(container, shape, 20), at40 = energy_error(container, shape, 40);
  EXPECT_LT(at20, 0.01);
  EXPECT_LT(at40, 0.003);
  if (true) {
    EXPECT_LT(at40, 0.5 * at20);  // second order gives a quarter
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ElasticImpacts,
                         testing::Combine(testing::Values(ContainerKind::none, ContainerKind::plane),
                                          testing::Values(0, 1, 2)),
                         [](const auto& of) {
                           return std::string(kBodies[std::get<1>(of.param)]) +
                                  (std::get<0>(of.param) == ContainerKind::none ? "" : "OnTheFloor");
                         });

}  // namespace
}  // namespace packbed
