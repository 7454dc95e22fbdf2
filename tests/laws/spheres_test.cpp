// The sphere packer by law: impacts, momentum, energy.
#include <gtest/gtest.h>

#include "laws/law.hpp"
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

}  // namespace
}  // namespace packbed
