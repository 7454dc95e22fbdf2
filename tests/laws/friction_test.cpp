// Coulomb friction on a floor: sliding, sticking, rolling, toppling. An incline is a tilted gravity.
#include <gtest/gtest.h>

#include "laws/law.hpp"

namespace packbed {
namespace {

using namespace law;

double degrees(double angle) {
  return angle * 180 / kPi;
}
double radians(double angle) {
  return angle * kPi / 180;
}

// Standing on its flat end: friction mu m g stops it after v^2 / (2 mu g).
TEST(SlidingBlock, StopsAfterVSquaredOverTwoMuG) {
  for (const double mu : {0.2, 0.5}) {
    Scene s = scene(ContainerKind::plane, make_cylinder("disc", 4e-3, 2e-3));
    set_contact(s, mu, 0.3);
    s.gravity = {0, 0, -kGravity};
    const double speed = 0.5, path = speed * speed / (2 * mu * kGravity);
    place(s, {0, 0, 1e-3}).velocity = {speed, 0, 0};
    const Course r = run(s, 1.2 * speed / (mu * kGravity));
    EXPECT_NEAR(r.end().pose.position.x() / path, 1, 0.01) << mu;
    EXPECT_LT(r.end().velocity.norm(), 1e-4 * speed) << mu;
    EXPECT_NEAR(r.end().pose.position.y() / path, 0, 1e-6) << mu;
  }
}

/// How far a standing A38 slides in the second half of `duration` on an incline.
double slip(double angle, double mu, double duration) {
  Scene s = scene(ContainerKind::plane, a38());
  set_contact(s, mu, 0.3);
  tilt(s, angle);
  place(s, {0, 0, kHeight / 2});
  const Course r = run(s, duration);
  return r.end().pose.position.x() - r.frames[r.frames.size() / 2].pellets[0].pose.position.x();
}

TEST(Incline, HoldsBelowTheFrictionAngleWithoutCreep) {
  for (const double mu : {0.2, 0.5}) {
    const double creep = slip(std::atan(mu) - radians(0.1), mu, 2);
    EXPECT_LT(std::abs(creep), 1e-4 * kDiameter) << mu;  // within a second
  }
}

TEST(Incline, SlipsAboveTheFrictionAngle) {
  for (const double mu : {0.2, 0.5}) {
    const double angle = std::atan(mu) + radians(0.1),
                 acceleration = kGravity * (std::sin(angle) - mu * std::cos(angle));
    const double expected = 0.5 * acceleration * (1 - 0.25);  // in the second half of the first second
    EXPECT_NEAR(slip(angle, mu, 1) / expected, 1, 0.1) << mu;
    const double steep = std::atan(mu) + radians(3);
    EXPECT_NEAR(slip(steep, mu, 1) / (0.375 * kGravity * (std::sin(steep) - mu * std::cos(steep))), 1, 0.02)
        << mu;
  }
}

struct Roller {
  const char* name;
  bool ball;
  double share;  // of g sin(a): m r^2 / (m r^2 + I)
};

class Rolling : public testing::TestWithParam<Roller> {
 protected:
  static constexpr double kRadius = 2e-3;
  Scene s = scene(ContainerKind::plane,
                  GetParam().ball ? make_sphere("ball", kRadius) : make_cylinder("rod", 2 * kRadius, 4e-3));
  PlacedPellet& put() { return place(s, {0, 0, kRadius}, lying()); }
};

TEST_P(Rolling, DownAnInclineHasItsShareOfTheAcceleration) {
  set_contact(s, 0.5, 0.3);
  tilt(s, radians(20));
  put();
  const Course r = run(s, 0.3);
  const double acceleration = GetParam().share * kGravity * std::sin(radians(20)), t = r.frames.back().time;
  EXPECT_NEAR(r.end().pose.position.x() / (0.5 * acceleration * t * t), 1, 0.01);
  EXPECT_NEAR(r.end().velocity.x() / (acceleration * t), 1, 0.01);
  EXPECT_NEAR(r.end().spin.y() * kRadius / r.end().velocity.x(), 1, 0.005);  // no slip
  EXPECT_LT(std::abs(r.end().pose.position.y()), 0.01 * kRadius);
}

// Pushed without spin: friction brakes and spins it until it rolls, at the share of its speed, whatever mu.
TEST_P(Rolling, SlidingTurnsIntoRollingAtItsShareOfTheSpeed) {
  const double mu = 0.3, speed = 0.5, share = GetParam().share;
  set_contact(s, mu, 0.3);
  s.gravity = {0, 0, -kGravity};
  put().velocity = {speed, 0, 0};
  const double until = (1 - share) * speed / (mu * kGravity);  // v - mu g t = share v
  const Course r = run(s, 2 * until);
  EXPECT_NEAR(r.end().velocity.x() / speed, share, 0.005);
  EXPECT_NEAR(r.end().spin.y() * kRadius / speed, share, 0.005);
  const double slid = speed * until - 0.5 * mu * kGravity * until * until,
               rolled = share * speed * (r.frames.back().time - until);
  EXPECT_NEAR(r.end().pose.position.x() / (slid + rolled), 1, 0.01);
}

// Too steep to roll: it slides with g (sin a - mu cos a) and the spin grows by mu m g cos(a) r / I.
TEST_P(Rolling, SlidesWhereFrictionCannotTurnItFastEnough) {
  const double mu = 0.1, angle = radians(45);
  ASSERT_LT(mu, (1 - GetParam().share) * std::tan(angle));
  set_contact(s, mu, 0.3);
  tilt(s, angle);
  put();
  const Course r = run(s, 0.1);
  const double t = r.frames.back().time;
  EXPECT_NEAR(r.end().velocity.x() / (kGravity * (std::sin(angle) - mu * std::cos(angle)) * t), 1, 0.01);
  const double per_mass = (1 / GetParam().share - 1) * kRadius * kRadius;  // I / m
  EXPECT_NEAR(r.end().spin.y() / (mu * kGravity * std::cos(angle) * kRadius / per_mass * t), 1, 0.01);
}

// A moment c R* m g against rolling brakes it by its share of c g R* / r, until it stands.
TEST_P(Rolling, RollingFrictionBrakesEvenlyToAStop) {
  const double c = 0.05, speed = 0.2;
  const double reduced = 0.5 * s.pellets[0].shape->equivalent_diameter();
  set_contact(s, 0.5, 0.3);
  s.wall_contact.rolling_friction = c;
  s.gravity = {0, 0, -kGravity};
  PlacedPellet& roller = put();
  roller.velocity = {speed, 0, 0};
  roller.spin = {0, speed / kRadius, 0};
  const double brake = GetParam().share * c * kGravity * reduced / kRadius, stop = speed / brake;
  EXPECT_NEAR(run(s, 0.5 * stop).end().velocity.x() / (0.5 * speed), 1, 0.01);
  const Course r = run(s, 1.5 * stop);
  EXPECT_LT(r.end().velocity.norm(), 1e-3 * speed);
  EXPECT_NEAR(r.end().pose.position.x() / (0.5 * speed * stop), 1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Of, Rolling,
                         testing::Values(Roller{"Ball", true, 5.0 / 7}, Roller{"Rod", false, 2.0 / 3}),
                         [](const auto& of) { return of.param.name; });

/// Angle between the axis and the floor's normal after half a second on an incline [degrees]; falls over or
/// not.
constexpr double kTopplingMargin = 5;  // degrees

struct Stand {
  double lean, slid;
};
Stand stand(double angle, double mu, double slenderness) {
  Scene s = scene(ContainerKind::plane, make_cylinder("post", kDiameter, slenderness * kDiameter));
  set_contact(s, mu, 0.3);
  s.wall_contact.stiffness = 1e6;  // put down unloaded, it rocks: the softer the floor, the further
  tilt(s, angle);
  place(s, {0, 0, 0.5 * slenderness * kDiameter});
  const Course r = run(s, 0.5);
  const Vec3 axis = r.end().pose.rotation * Vec3::UnitZ();
  return {degrees(std::acos(std::min(1.0, std::abs(axis.z())))), r.end().pose.position.x()};
}

// The weight's line leaves the base at tan(a) = D / L. Put down unloaded within some degrees of that, it
// rocks over.
TEST(StandingCylinder, TopplesAboveDOverLWhereFrictionHolds) {
  for (const double slenderness : {1.0, 2.0}) {
    const double limit = std::atan(1 / slenderness);
    EXPECT_LT(stand(limit - radians(kTopplingMargin), 1.3, slenderness).lean, 5) << slenderness;
    EXPECT_GT(stand(limit + radians(kTopplingMargin), 1.3, slenderness).lean, 10) << slenderness;
  }
}

TEST(StandingCylinder, SlidesUprightWhereFrictionIsLess) {
  const double mu = 0.3, angle = std::atan(0.5) - radians(3);  // below the toppling angle of L = 2 D
  const Stand s = stand(angle, mu, 2);
  EXPECT_LT(s.lean, 1);
  EXPECT_NEAR(s.slid / (0.125 * kGravity * (std::sin(angle) - mu * std::cos(angle))), 1, 0.02);
}

// Torsion: a disc that spins on its flat end is braked by mu times the weight at the mean radius of its
// pressure, which lies between 0 and the rim.
TEST(SpinningDisc, IsBrakedByTheTorsionOfItsPatch) {
  const double radius = 2e-3, mu = 0.3, spin = 100;
  Scene s = scene(ContainerKind::plane, make_cylinder("disc", 2 * radius, 2e-3));
  set_contact(s, mu, 0.3);
  s.gravity = {0, 0, -kGravity};
  place(s, {0, 0, 1e-3}).spin = {0, 0, spin};
  const double fastest =
      spin * radius / (2 * mu * kGravity);  // all weight on the rim: I w = mu m g r t, I = m r^2 / 2
  const Course r = run(s, 4 * fastest);
  EXPECT_LT(std::abs(r.end().spin.z()), 1e-3 * spin);
  double stopped = 0;
  for (const Frame& f : r.frames)
    if (f.pellets[0].spin.z() > 0.01 * spin) stopped = f.time;
  EXPECT_GT(stopped, 0.9 * fastest);
  s.wall_contact.torsion = false;
  EXPECT_NEAR(run(s, fastest).end().spin.z() / spin, 1, 1e-3);
}

}  // namespace
}  // namespace packbed
