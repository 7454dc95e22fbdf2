// The sphere packer by law: impacts, momentum, energy.
#include <gtest/gtest.h>

#include "laws/law.hpp"
#include "math/clock.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

using namespace law;

Scene sphere_scene(ContainerKind container, std::vector<ShapePtr> shapes) {
  Scene s = scene(container, std::move(shapes));
  s.method = "spheres";
  return s;
}

class SphereImpact : public testing::TestWithParam<double> {};

// Pellet on floor and pellet on pellet: the spring and dashpot that let go when their force ends.
TEST_P(SphereImpact, HasTheRestitutionOfTheSpringAndDashpotThatLetGo) {
  const double zeta = GetParam(), speed = 0.5;
  Scene floor = sphere_scene(ContainerKind::plane, {make_sphere("ball", 2e-3)});
  set_contact(floor, 0.3, zeta);
  floor.stepping.steps_per_contact = 100;
  place(floor, {0, 0, 2.1e-3}).velocity = {0, 0, -speed};
  EXPECT_NEAR(run(floor, 2e-3).end().velocity.z() / speed, restitution(zeta), 0.005);

  Scene pair = sphere_scene(ContainerKind::none, {make_sphere("small", 1e-3), make_sphere("large", 3e-3)});
  set_contact(pair, 0.3, zeta);
  pair.stepping.steps_per_contact = 100;
  place(pair, {-1.1e-3, 0, 0}).velocity = {1, 0, 0};
  PlacedPellet& large = place(pair, {3.1e-3, 0, 0});
  large.kind = 1;
  large.velocity = {-0.2, 0, 0};
  const Course r = run(pair, 0.003);
  EXPECT_NEAR((r.end(1).velocity.x() - r.end(0).velocity.x()) / 1.2, restitution(zeta), 0.005);
}

INSTANTIATE_TEST_SUITE_P(Damping, SphereImpact, testing::Values(0.0, 0.05, 0.1, 0.2, 0.3, 0.5),
                         [](const auto& of) {
                           return "Zeta" + std::to_string(static_cast<int>(100 * of.param));
                         });

/// A hundred spheres of two sizes that fly into each other.
Scene cluster(double friction, double zeta) {
  Scene s = sphere_scene(ContainerKind::none, {make_sphere("small", 1e-3), make_sphere("large", 2.5e-3)});
  set_contact(s, friction, zeta);
  for (int i = 0; i < 100; ++i) {
    Random random(11, Stream::test, static_cast<std::uint32_t>(i));
    const Vec3 at = 6e-3 * Vec3(i % 5 - 2.0, i / 5 % 5 - 2.0, i / 25 - 1.5);
    PlacedPellet& p = place(s, at);
    p.kind = i % 3 == 0;
    p.velocity = -20.0 * at + 0.2 * random.on_sphere();
    p.spin = 50.0 * random.on_sphere();
  }
  return s;
}

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double size = 0, angular_size = 0;
};
Momenta momenta(const Scene& s, const Frame& f) {
  Momenta m;
  for (const Pellet& p : f.pellets) {
    const Vec3 own = mass(s, p) * p.velocity, turning = p.pose.position.cross(own) + spin_momentum(s, p);
    m.linear += own;
    m.angular += turning;
    m.size += own.norm();
    m.angular_size += turning.norm();
  }
  return m;
}

TEST(SphereCluster, KeepsItsMomentumAndAngularMomentum) {
  const Scene s = cluster(0.5, 0.2);
  const Course r = run(s, 0.05);
  EXPECT_GT(r.result.record.counters.at("touches"), 1000);
  const Momenta before = momenta(s, r.frames.front()), after = momenta(s, r.frames.back());
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.size);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-10 * before.angular_size);
}

TEST(SphereCluster, LosesWhatItsBooksSay) {
  for (const auto& [friction, zeta] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.0, 0.3}, {0.5, 0.3}}) {
    Scene s = cluster(friction, zeta);
    s.stepping.steps_per_contact = 40;
    const Course r = run(s, 0.05);
    const auto& e = r.result.record.energy;
    EXPECT_LT(e.ledger_error, 0.004) << friction << ' ' << zeta;
    EXPECT_GE(e.rubbed, friction > 0 ? 0.01 * e.input : 0.0);
    EXPECT_GE(e.damped, zeta > 0 ? 0.1 * e.input : 0.0);
  }
}

/// Velocity and surface speed (spin times radius) of pellet 0 at the end, at so many steps a contact.
std::pair<Vec3, Vec3> thrown(Scene s, double steps_per_contact, double duration) {
  s.stepping.steps_per_contact = steps_per_contact;
  const Pellet p = run(std::move(s), duration).end();
  return {p.velocity, 0.265e-3 * p.spin};
}

// Mass ratio 4e4: the history of the friction of a small sphere at a large one, which turns the line between
// their centres fast (Vyas et al. 2025). The same throw with steps twenty times shorter is the reference.
TEST(SizeRatio34, SmallSphereLeavesALargeOneAsWithShortSteps) {
  for (const double aside : {0.2, 0.5, 0.8}) {
    Scene s =
        sphere_scene(ContainerKind::none, {make_sphere("small", 0.265e-3), make_sphere("large", 9.12e-3)});
    set_contact(s, 0.8, 0);
    const double reach = 9.385e-3;
    place(s, {aside * reach, 0, std::sqrt(1 - aside * aside) * reach + 1e-5}).velocity = {0, 0, -1};
    place(s, {0, 0, 0}).kind = 1;
    const auto [v, w] = thrown(s, 20, 3e-4);
    const auto [v_fine, w_fine] = thrown(s, 400, 3e-4);
    ASSERT_GT(v_fine.x(), 0.05);
    EXPECT_LT((v - v_fine).norm(), 0.01) << aside;
    EXPECT_LT((w - w_fine).norm(), 0.01) << aside;
  }
}

// Two large spheres close on a small one between them, off their line: it must come out, neither stuck nor
// thrown.
TEST(SizeRatio34, SmallSphereIsPressedOutBetweenTwoLargeOnes) {
  Scene s =
      sphere_scene(ContainerKind::none, {make_sphere("small", 0.265e-3), make_sphere("large", 9.12e-3)});
  set_contact(s, 0.1, 0.1);  // the wedge of 13.6 degrees holds a sphere when friction is over 0.24
  const double apart = 9.385e-3 * std::cos(0.21), off = 9.385e-3 * std::sin(0.21);
  place(s, {0, 0, off + 1e-6});
  for (const double side : {-1.0, 1.0}) {
    PlacedPellet& large = place(s, {side * (apart + 1e-6), 0, 0});
    large.kind = 1;
    large.velocity = {-side * 0.05, 0, 0};
  }
  const auto [v, w] = thrown(s, 20, 1.5e-3);
  const auto [v_fine, w_fine] = thrown(s, 200, 1.5e-3);
  ASSERT_GT(v_fine.z(), 0.05);
  EXPECT_NEAR(v.z() / v_fine.z(), 1, 0.01);
  EXPECT_LT(std::hypot(v.x(), v.y()), 1e-6);
}

/// A block of spheres of two sizes at rest, nearly touching, that a few fast ones are shot into.
Scene shot_into_a_block() {
  Scene s = sphere_scene(ContainerKind::plane, {make_sphere("small", 0.8e-3), make_sphere("large", 1e-3)});
  set_contact(s, 0.3, 0.1);
  for (int i = 0; i < 500; ++i) {
    PlacedPellet& p =
        place(s, Vec3(2.02e-3 * (i % 10), 2.02e-3 * (i / 10 % 10), 1.01e-3 + 2.02e-3 * (i / 100)));
    p.kind = i % 3 == 0;
  }
  for (int i = 0; i < 4; ++i) place(s, {2.02e-3 * (3 + i), 9e-3, 14e-3}).velocity = {0.5 * i, 0, -8};
  return s;
}

// A hit sphere leaves its margin at once and gets partners of its own, without a search for all. With a skin
// so thick that nobody ever leaves it, all that can touch is listed from the start: the same course.
TEST(ListsBetweenSearches, MissNoContact) {
  const double end = 1.5e-3;
  Scene s = shot_into_a_block();
  const Course some = run(s, end);
  const auto& counters = some.result.record.counters;
  EXPECT_GT(counters.at("spheres_listed_between_searches"), 3 * counters.at("searches"));
  ASSERT_GT(counters.at("touches"), 1000);
  s.stepping.skin = 14e-3;
  const Course all = run(s, end);
  EXPECT_EQ(all.result.record.counters.at("searches"), 1);
  EXPECT_EQ(some.result.record.counters.at("touches"), all.result.record.counters.at("touches"));
  for (std::size_t i = 0; i < s.feed.placed.size(); ++i)
    ASSERT_LT((some.end(i).pose.position - all.end(i).pose.position).norm(), 1e-9) << i;
}

// A ball that rolls on a floor: rolling friction brakes it by mu_r g / (1 + 2/5).
TEST(RollingFriction, BrakesARollingBall) {
  const double radius = 2e-3, mu = 0.05, speed = 0.2;
  Scene s = sphere_scene(ContainerKind::plane, {make_sphere("ball", radius)});
  set_contact(s, 0.5, 0.3);
  s.wall_contact.rolling_friction = mu;
  s.gravity = {0, 0, -kGravity};
  PlacedPellet& p = place(s, {0, 0, radius});
  p.velocity = {speed, 0, 0};
  p.spin = {0, speed / radius, 0};
  const double time = 0.3;
  EXPECT_NEAR(run(s, time).end().velocity.x(), speed - mu * kGravity / 1.4 * time, 0.002);
  s.wall_contact.rolling_friction = 0;
  EXPECT_NEAR(run(s, time).end().velocity.x(), speed, 1e-4);
}

// Both integrators tend to the same course.
TEST(Gear, FollowsTheCourseOfVelocityVerlet) {
  Scene s = cluster(0.3, 0.1);
  s.stepping.steps_per_contact = 200;
  const double end = 0.012;  // the first impacts; later ones tell apart what rounding has made different
  const Course verlet = run(s, end);
  s.stepping.gear = true;
  const Course gear = run(s, end);
  ASSERT_GT(verlet.result.record.counters.at("touches"), 100);
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_LT((gear.end(i).pose.position - verlet.end(i).pose.position).norm(), 2e-6) << i;
}

/// Two hundred pairs far from each other that hit one another obliquely; velocities of all when they have
/// parted.
std::vector<Vec3> after_impacts(double steps_per_contact, bool gear, double& cpu_s) {
  Scene s = sphere_scene(ContainerKind::none, {make_sphere("ball", 2e-3)});
  set_contact(s, 0.3, 0.1);
  s.stepping.steps_per_contact = steps_per_contact;
  s.stepping.gear = gear;
  for (int i = 0; i < 200; ++i) {
    Random random(8, Stream::test, static_cast<std::uint32_t>(i));
    const Vec3 at(0.03 * (i % 20), 0.03 * (i / 20), 0), along = random.on_sphere();
    const Vec3 aside = random.on_sphere().cross(along);
    place(s, at + 2.02e-3 * along + 1e-3 * aside).velocity = -0.4 * along;
    PlacedPellet& p = place(s, at - 2.02e-3 * along);
    p.velocity = 0.4 * along;
    p.spin = 100.0 * random.on_sphere();
  }
  const double begin = cpu_seconds();
  const Course r = run(s, 4e-3, 4e-3);
  cpu_s = cpu_seconds() - begin;
  std::vector<Vec3> velocities;
  for (const Pellet& p : r.frames.back().pellets) velocities.push_back(p.velocity);
  return velocities;
}

// The table of docs/spheres.md: error of the velocity after an impact over the speed before, root mean
// square, against run time. Contacts begin and end with a kink, so the order of both schemes is that of the
// force there, not their own.
TEST(Integrators, ErrorFallsWithTheStep) {
  double unused = 0;
  const std::vector<Vec3> exact = after_impacts(2560, false, unused);
  for (const bool gear : {false, true}) {
    double last = 1;
    for (const double steps : {20.0, 40.0, 80.0, 160.0}) {
      double cpu = 0, squares = 0;
      const std::vector<Vec3> found = after_impacts(steps, gear, cpu);
      for (std::size_t i = 0; i < exact.size(); ++i) squares += (found[i] - exact[i]).squaredNorm() / 0.16;
      const double error = std::sqrt(squares / static_cast<double>(exact.size()));
      std::printf("%-7s %4.0f steps a contact: error %.2e, %.3f CPU s\n", gear ? "gear" : "verlet", steps,
                  error, cpu);
      EXPECT_LT(error, 0.75 * last) << gear << ' ' << steps;
      last = error;
    }
    EXPECT_LT(last, 2e-3);
  }
}

}  // namespace
}  // namespace packbed
