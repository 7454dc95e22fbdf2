// What bodies do while nothing, or only another body, touches them.
#include <gtest/gtest.h>

#include "laws/law.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

using namespace law;

ShapePtr brick() {  // three different principal moments
  const Vec3 half(1.5e-3, 1.0e-3, 2.2e-3);
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(),
                               (i & 4 ? 1 : -1) * half.z());
  for (const auto& q :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return make_shape("brick", "built in the test", mesh);
}

// z = z0 + v t - g t^2 / 2 and nothing sideways: velocity Verlet, and a leap, are exact for a constant force.
TEST(FreeFall, FollowsTheParabola) {
  Scene s = scene(ContainerKind::plane, a38());
  s.gravity = {0, 0, -kGravity};
  const Vec3 from(1e-3, -2e-3, 0.5), speed(0.1, -0.2, 0.3);
  PlacedPellet& p = place(s, from, Random(1, Stream::test, 0).rotation());
  p.velocity = speed;
  p.spin = {30, -20, 10};
  const Course r = run(s, 0.3);
  ASSERT_GE(r.frames.size(), 50);
  EXPECT_NEAR(r.frames.back().time, 0.3, 2e-5);
  for (const Frame& f : r.frames) {
    const Vec3 expected = from + speed * f.time + 0.5 * f.time * f.time * s.gravity;
    EXPECT_LT((f.pellets[0].pose.position - expected).norm(), 1e-12) << f.time;
    EXPECT_LT((f.pellets[0].velocity - (speed + f.time * s.gravity)).norm(), 1e-11) << f.time;
  }
}

TEST(FreeFall, KeepsTheEnergyThatTheSnapshotsTell) {
  Scene s = scene(ContainerKind::plane, a38());
  s.gravity = {0, 0, -kGravity};
  PlacedPellet& p = place(s, {0, 0, 0.5}, Random(1, Stream::test, 1).rotation());
  p.spin = {300, -200, 100};
  const Course r = run(s, 0.3);
  const auto total = [](const Frame& f) {
    return f.energies.at(0).translation + f.energies.at(0).rotation + f.energies.at(0).height;
  };
  for (const Frame& f : r.frames) {
    EXPECT_NEAR(total(f), total(r.frames.front()), 1e-9 * std::abs(total(r.frames.front()))) << f.time;
    EXPECT_NEAR(f.energies[0].translation + f.energies[0].rotation, kinetic(s, f.pellets[0]),
                1e-12 * kinetic(s, f.pellets[0]));
  }
}

class TorqueFreeTop : public testing::TestWithParam<int> {};

// No torque: kinetic energy and world angular momentum stay, the quaternion stays on the unit sphere.
TEST_P(TorqueFreeTop, KeepsEnergyAndMomentum) {
  Scene s = scene(ContainerKind::none, GetParam() == 0 ? a38() : brick());
  PlacedPellet& p = place(s, Vec3::Zero(), Random(1, Stream::test, 2).rotation());
  p.spin = {60, 80, -40};
  s.stepping.step = 1e-5;
  const Course r = run(s, 2, 0.02);  // 200,000 steps, some 30 turns
  const Pellet& first = r.frames.front().pellets[0];
  const double energy = kinetic(s, first);
  const Vec3 momentum = spin_momentum(s, first);
  double turned = 0;
  for (const Frame& f : r.frames) {
    const Pellet& now = f.pellets[0];
    EXPECT_NEAR(kinetic(s, now) / energy, 1, 1e-6);
    EXPECT_LT((spin_momentum(s, now) - momentum).norm() / momentum.norm(), 1e-6);
    EXPECT_NEAR(now.pose.rotation.norm(), 1, 1e-14);
    turned = std::max(turned, now.pose.rotation.angularDistance(first.pose.rotation));
  }
  EXPECT_GT(turned, 1);  // it did turn
}

// A symmetric top precesses about its angular momentum at the rate L / I of the transverse moment (Euler).
TEST(TorqueFreeTopOfRevolution, PrecessesAtItsRate) {
  Scene s = scene(ContainerKind::none, a38());
  place(s, Vec3::Zero()).spin = {50, 0, 120};
  s.stepping.step = 1e-5;
  const Course r = run(s, 0.5, 0.5);
  const Pellet& first = r.frames.front().pellets[0];
  const Vec3 momentum = spin_momentum(s, first);
  const double transverse = kDensity * s.pellets[0].shape->inertia.x();
  const Quat precession(
      Eigen::AngleAxisd(momentum.norm() / transverse * r.frames.back().time, momentum.normalized()));
  const Vec3 axis = r.end().pose.rotation * Vec3::UnitZ();
  EXPECT_LT((axis - precession * Vec3::UnitZ()).norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Of, TorqueFreeTop, testing::Values(0, 1),
                         [](const auto& of) { return of.param == 0 ? "Cylinder" : "Brick"; });

/// `n` bodies on a grid in free space, flying inwards, turning.
void add_cloud(Scene& s, int n, double spacing) {
  const int side = static_cast<int>(std::ceil(std::cbrt(n)));
  for (int i = 0; i < n; ++i) {
    Random random(3, Stream::test, static_cast<std::uint32_t>(i));
    const Vec3 cell(i % side, i / side % side, i / side / side);
    PlacedPellet& p = place(s, spacing * (cell - Vec3::Constant(0.5 * (side - 1))), random.rotation());
    p.kind = static_cast<std::uint32_t>(i) % static_cast<std::uint32_t>(s.pellets.size());
    p.velocity = -20 * p.pose.position + 0.3 * random.on_sphere();
    p.spin = 100 * random.on_sphere();
  }
}

// Forces come in pairs with one line of action: momentum and angular momentum of an isolated cloud stay, with
// friction and damping.
TEST(IsolatedCloud, KeepsMomentumAndAngularMomentum) {
  Scene s = scene(ContainerKind::none, {a38(), make_sphere("ball", 1.9e-3)});
  set_contact(s, 0.5, 0.2);
  add_cloud(s, 100, 5.2e-3);
  const Course r = run(s, 0.1, 0.005);
  const auto sums = [&](const Frame& f) {
    std::array<Vec3, 2> sum{Vec3::Zero(), Vec3::Zero()};
    std::array<double, 2> size{0, 0};
    for (const Pellet& p : f.pellets) {
      const Vec3 linear = mass(s, p) * p.velocity,
                 angular = p.pose.position.cross(linear) + spin_momentum(s, p);
      sum[0] += linear;
      sum[1] += angular;
      size[0] += linear.norm();
      size[1] += angular.norm();
    }
    return std::pair(sum, size);
  };
  const auto [first, size] = sums(r.frames.front());
  double energy = 0, left = 0;
  for (const Pellet& p : r.frames.front().pellets) energy += kinetic(s, p);
  for (const Pellet& p : r.frames.back().pellets) left += kinetic(s, p);
  for (const Frame& f : r.frames) {
    const auto now = sums(f).first;
    EXPECT_LT((now[0] - first[0]).norm() / size[0], 1e-12) << f.time;
    EXPECT_LT((now[1] - first[1]).norm() / size[1], 1e-10) << f.time;
  }
  EXPECT_LT(left, 0.8 * energy);  // they did collide
}

/// Two cylinders that hit each other off centre, with friction; `turn` maps the whole scene.
Scene collision(const Mat3& turn) {
  Scene s = scene(ContainerKind::none, a38());
  set_contact(s, 0.4, 0.2);
  s.stepping.step = 1e-5;
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1 : -1;
    const Quat rotation = Random(4, Stream::test, static_cast<std::uint32_t>(i)).rotation();
    PlacedPellet& p =
        place(s, turn * Vec3(sign * 2.6e-3, sign * 0.4e-3, -sign * 0.3e-3), Quat(turn) * rotation);
    p.velocity = turn * Vec3(-sign * 0.5, 0.1, 0.2);
    p.spin = turn * Vec3(20, sign * 30, -10);
  }
  return s;
}

// Nothing in free space knows which axis is which: exchanging x, y, z of the scene exchanges them in the
// result.
TEST(Axes, MayBePermuted) {
  Mat3 turn;
  turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const Course plain = run(collision(Mat3::Identity()), 0.01, 0.0005),
               turned = run(collision(turn), 0.01, 0.0005);
  ASSERT_EQ(plain.frames.size(), turned.frames.size());
  const double steps = static_cast<double>(plain.result.record.time.steps);
  const double rounding = 1e-12 * steps;
  for (std::size_t f = 0; f < plain.frames.size(); ++f)
    for (std::size_t i = 0; i < 2; ++i) {
      const Pellet &a = plain.frames[f].pellets[i], &b = turned.frames[f].pellets[i];
      EXPECT_LT((turn * a.pose.position - b.pose.position).norm(), rounding * kDiameter);
      EXPECT_LT((turn * a.velocity - b.velocity).norm(), rounding * 0.5);
      EXPECT_LT((turn * a.spin - b.spin).norm(), rounding * 300);
    }
  EXPECT_GT((plain.end().velocity - plain.frames.front().pellets[0].velocity).norm(),
            0.1);  // they did collide
}

// No length is built in: lengths, speeds and stiffness scaled to a body 1000 times larger give the same
// flight and the same impact in its own diameters.
TEST(Units, MayBeScaled) {
  const double scale =
      1000;  // of lengths; times and densities stay, so masses, and with them stiffness, grow by its cube
  Scene small = collision(Mat3::Identity()), large = small;
  large.pellets[0].shape = make_cylinder("large", scale * kDiameter, scale * kHeight);
  large.pellet_contact.stiffness *= scale * scale * scale;
  for (PlacedPellet& p : large.feed.placed) {
    p.pose.position *= scale;
    p.velocity *= scale;
  }
  const Course a = run(small, 0.01, 0.0005), b = run(large, 0.01, 0.0005);
  ASSERT_EQ(a.result.record.time.steps, b.result.record.time.steps);
  const double allowed = 1e-9 * static_cast<double>(a.result.record.time.steps);
  for (std::size_t f = 0; f < a.frames.size(); ++f)
    for (std::size_t i = 0; i < 2; ++i) {
      const Pellet &p = a.frames[f].pellets[i], &q = b.frames[f].pellets[i];
      EXPECT_LT((p.pose.position - q.pose.position / scale).norm() / kDiameter, allowed);
      EXPECT_LT((p.velocity - q.velocity / scale).norm() / 0.5, allowed);
      EXPECT_LT((p.spin - q.spin).norm() / 300, allowed);
    }
}

}  // namespace
}  // namespace packbed
