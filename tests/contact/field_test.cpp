#include "contact/field.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "../shapes.hpp"
#include "math/error.hpp"
#include "math/random.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

constexpr double kD = 3.42e-3;

std::shared_ptr<Shape> a38_mesh() {
  return test::mesh_body(test::prism(1.71e-3, 1.73e-3, 48), test::a38()->volume, kD);
}
std::shared_ptr<Shape> box_shape() {
  return test::mesh_body(test::box({1.5e-3, 1.6e-3, 1.7e-3}), 32.64e-9, 3e-3);
}

/// Bodies that the tests share; made once.
const FieldBody& mesh_body() {
  static const FieldBody body = make_field_body(*a38_mesh());
  return body;
}
const FieldBody& rod_body() {
  static const FieldBody body = make_field_body(*test::a38());
  return body;
}
const FieldBody& ball_body() {
  static const FieldBody body = make_field_body(*test::sphere(1.8e-3));
  return body;
}
const FieldBody& box_body() {
  static const FieldBody body = make_field_body(*box_shape());
  return body;
}

struct Pair {
  FieldPellet a, b;
};

/// Two bodies at random rotations, brought together until the greatest depth is `depth`.
Pair touching(const FieldBody& a, const FieldBody& b, Random& random, double depth) {
  Pair pair{{&a, {Vec3(0.3, -0.2, 0.1), random.rotation()}}, {&b, {Vec3::Zero(), random.rotation()}}};
  const Vec3 direction = random.on_sphere();
  double low = 1.5e-3, high = 6e-3;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    pair.b.pose.position = pair.a.pose.position + middle * direction;
    (touch_field(pair.a, pair.b).depth > depth ? low : high) = middle;
  }
  pair.b.pose.position = pair.a.pose.position + low * direction;
  return pair;
}

Pose turned(const Pose& pose, const Vec3& rotation) {
  const double angle = rotation.norm();
  if (!(angle > 0)) return pose;
  return {pose.position, Quat(Eigen::AngleAxisd(angle, rotation / angle)) * pose.rotation};
}

/// Every pair of kinds of body.
void for_pairs(const std::function<void(const FieldBody&, const FieldBody&)>& check) {
  const FieldBody* bodies[] = {&mesh_body(), &rod_body(), &ball_body(), &box_body()};
  for (const FieldBody* a : bodies)
    for (const FieldBody* b : bodies) check(*a, *b);
}

TEST(FieldKernel, ForceAndTorquesAreTheGradientOfDelta) {
  Random random(1, Stream::test, 0);
  for_pairs([&](const FieldBody& a, const FieldBody& b) {
    for (int i = 0; i < 6; ++i) {
      const Pair pair = touching(a, b, random, (i + 1) * 0.004 * kD);
      const Touch t = touch_field(pair.a, pair.b);
      ASSERT_GT(t.delta, 0);
      const double step = 2e-9, angle = 2e-6;
      const auto delta = [&](const Vec3& move, const Vec3& turn_a, const Vec3& turn_b) {
        Pair p = pair;
        p.a.pose.position += move;
        p.a.pose = turned(p.a.pose, turn_a);
        p.b.pose = turned(p.b.pose, turn_b);
        return touch_field(p.a, p.b).delta;
      };
      const Vec3 o = Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        const Vec3 u = Vec3::Unit(k);
        EXPECT_NEAR((delta(step * u, o, o) - delta(-step * u, o, o)) / (2 * step), -t.gradient[k], 1e-6);
        EXPECT_NEAR((delta(o, angle * u, o) - delta(o, -angle * u, o)) / (2 * angle), -t.torque_a[k],
                    1e-6 * kD);
        EXPECT_NEAR((delta(o, o, angle * u) - delta(o, o, -angle * u)) / (2 * angle), -t.torque_b[k],
                    1e-6 * kD);
      }
    }
  });
}

TEST(FieldKernel, AnswersWithTheOppositeWhenTheBodiesChangePlaces) {
  Random random(2, Stream::test, 0);
  for_pairs([&](const FieldBody& a, const FieldBody& b) {
    const Pair p = touching(a, b, random, 0.01 * kD);
    const Touch t = touch_field(p.a, p.b), u = touch_field(p.b, p.a);
    EXPECT_NEAR(t.delta, u.delta, 1e-12 * t.delta);
    EXPECT_LT((t.gradient + u.gradient).norm(), 1e-11);
    EXPECT_LT((t.torque_a - u.torque_b).norm(), 1e-11 * kD);
    EXPECT_LT((t.point - u.point).norm(), 1e-11 * kD);
  });
}

TEST(FieldKernel, TorquesBalanceAboutAnyPoint) {  // angular momentum of the pair is kept
  Random random(3, Stream::test, 0);
  for_pairs([&](const FieldBody& a, const FieldBody& b) {
    const Pair p = touching(a, b, random, 0.01 * kD);
    const Touch t = touch_field(p.a, p.b);
    const Vec3 arm = p.a.pose.position - p.b.pose.position;
    EXPECT_LT((t.torque_a + t.torque_b + arm.cross(t.gradient)).norm(), 1e-12 * kD);
  });
}

TEST(FieldKernel, FollowsARigidMotionOfThePair) {
  Random random(4, Stream::test, 0);
  for_pairs([&](const FieldBody& a, const FieldBody& b) {
    const Pair p = touching(a, b, random, 0.01 * kD);
    const Touch t = touch_field(p.a, p.b);
    const Quat q = random.rotation();
    const Vec3 shift(0.01, -0.02, 0.03);
    Pair moved = p;
    for (FieldPellet* pellet : {&moved.a, &moved.b})
      pellet->pose = {q * pellet->pose.position + shift, q * pellet->pose.rotation};
    const Touch u = touch_field(moved.a, moved.b);
    EXPECT_NEAR(u.delta, t.delta, 1e-9 * t.delta);
    EXPECT_LT((u.gradient - q * t.gradient).norm(), 1e-8);
    EXPECT_LT((u.torque_b - q * t.torque_b).norm(), 1e-8 * kD);
    EXPECT_LT((u.point - (q * t.point + shift)).norm(), 1e-8 * kD);
  });
}

TEST(FieldKernel, ScalesWithTheBodies) {
  Random random(5, Stream::test, 0);
  Pair p = touching(mesh_body(), box_body(), random, 0.01 * kD);
  const Touch t = touch_field(p.a, p.b);
  for (FieldPellet* pellet : {&p.a, &p.b}) pellet->scale = 3, pellet->pose.position *= 3;
  const Touch u = touch_field(p.a, p.b);
  EXPECT_NEAR(u.delta, 3 * t.delta, 1e-9 * u.delta);
  EXPECT_NEAR(u.depth, 3 * t.depth, 1e-9 * u.depth);
  EXPECT_LT((u.gradient - t.gradient).norm(), 1e-8);
  EXPECT_LT((u.torque_a - 3 * t.torque_a).norm(), 1e-8 * kD);
  EXPECT_NEAR(u.patch_radius, 3 * t.patch_radius, 1e-8 * kD);
}

TEST(FieldKernel, NoWorkRoundAClosedLoop) {
  Random random(6, Stream::test, 0);
  for (const auto& [a, b] :
       {std::pair{&mesh_body(), &mesh_body()}, {&mesh_body(), &ball_body()}, {&box_body(), &box_body()}}) {
    const Pair p = touching(*a, *b, random, 0.02 * kD);
    const Vec3 u = 0.01 * kD * random.on_sphere(), v = 0.01 * kD * random.on_sphere(),
               axis = random.on_sphere();
    const int n = 20000;
    double work = 0, most = 0;
    for (int i = 0; i < n; ++i) {  // trapezoid rule on a periodic path
      const double s = 2 * kPi * i / n, c = std::cos(s), w = std::sin(s);
      FieldPellet moving = p.a;
      moving.pose.position += c * u + w * v;
      moving.pose = turned(moving.pose, 0.02 * w * axis);
      const Touch t = touch_field(moving, p.b);
      const Vec3 velocity = -w * u + c * v, spin = 0.02 * c * axis;
      work += t.delta * (t.gradient.dot(velocity) + t.torque_a.dot(spin)) * 2 * kPi / n;
      most = std::max(most, 0.5 * t.delta * t.delta);
    }
    EXPECT_LT(std::abs(work), 1e-6 * most);
  }
}

TEST(FieldKernel, ForceHasNoJumpsWhileSliding) {
  Random random(7, Stream::test, 0);
  for (int run = 0; run < 4; ++run) {
    const Pair p = touching(mesh_body(), run % 2 ? box_body() : mesh_body(), random, 0.01 * kD);
    const Vec3 along = touch_field(p.a, p.b).gradient.cross(random.on_sphere()).normalized();
    const auto largest_step = [&](int n) {
      double most = 0;
      Vec3 last = Vec3::Zero();
      for (int i = 0; i <= n; ++i) {
        FieldPellet moving = p.a;
        moving.pose.position += (0.1e-3 * i / n) * along;
        const Touch t = touch_field(moving, p.b);
        const Vec3 force = t.delta * t.gradient;
        if (i > 0) most = std::max(most, (force - last).norm());
        last = force;
      }
      return most;
    };
    const double coarse = largest_step(500), fine = largest_step(5000);
    EXPECT_LT(fine, 0.15 * coarse + 1e-12);  // ten times smaller steps, ten times smaller changes
  }
}

TEST(FieldKernel, FlatOnFlatIsAsDeepAsItIsAndStraight) {
  for (const FieldBody* body : {&mesh_body(), &rod_body()}) {
    const double depth = 0.005 * kD;
    const FieldPellet low{body, {}}, high{body, {{0, 0, 2 * 1.73e-3 - depth}, Quat::Identity()}};
    const Touch t = touch_field(high, low);
    EXPECT_NEAR(t.delta, depth, 0.05 * depth);
    EXPECT_NEAR(t.depth, depth, 0.25 * depth);  // the field bulges a little next to a rim
    EXPECT_NEAR(t.gradient.z(), 1, 0.1);
    EXPECT_LT(t.gradient.head<2>().norm(), 0.01);
    EXPECT_LT(t.torque_a.norm(), 0.02 * kD);
    EXPECT_LT((t.point - Vec3(0, 0, 1.73e-3)).norm(), 0.03 * kD);
    EXPECT_NEAR(t.patch_radius, 1.71e-3 / std::sqrt(2), 0.1 * 1.71e-3);  // of a uniform disc
  }
}

TEST(FieldKernel, SphereOnSphereIsTheIntegralOfTheLaw) {
  const double r = 1.8e-3, gap = 2 * r - 0.02 * r;
  // by quadrature over one sphere: w = (1 + 2 kCurved) / R a unit area, depth (R^2 - |x - c|^2) / 2R
  double sum = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double angle = 0.5 * (i + 0.5) / n;  // from the line of centres; farther points are outside
    const double distance2 = r * r + gap * gap - 2 * r * gap * std::cos(angle);
    const double depth = std::max(0.0, (r * r - distance2) / (2 * r));
    sum += 2 * kPi * r * r * std::sin(angle) * (0.5 / n) * (1 + 2 * kCurved) / r *
           depth_power<kPointExponent>(depth);
  }
  const double delta = std::pow(2 * sum / (2 * kPi * r), 0.125);
  FieldOptions fine;
  fine.spacing = 0.05e-3;
  const FieldBody body = make_field_body(*test::sphere(r), fine);
  const Touch t = touch_field({&body, {}}, {&body, {{0, 0, gap}, Quat::Identity()}});
  EXPECT_NEAR(t.delta, delta, 1e-3 * delta);
  EXPECT_NEAR(t.gradient.normalized().z(), -1, 1e-4);
  EXPECT_NEAR(t.point.z(), gap / 2, 0.01 * r);
}

TEST(FieldKernel, SidesThatCrossAreSeenBetweenTheirPoints) {  // a quarter of a per cent deep
  Random random(8, Stream::test, 0);
  const double overlap = 0.0025 * kD, thinnest = 2 * 1.71e-3;
  for (int i = 0; i < 300; ++i) {
    const auto turned_about_its_axis = [&](const Quat& lies) {
      return lies * Quat(Eigen::AngleAxisd(random.uniform(0, 2 * kPi), Vec3::UnitZ()));
    };
    const auto along = [&] { return random.uniform(-0.8e-3, 0.8e-3); };
    const Quat lies = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
    const double angle = random.uniform(0.2, kPi / 2);
    const Quat other = Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ())) * lies;
    const FieldPellet a{&mesh_body(), {along() * Vec3::UnitX(), turned_about_its_axis(lies)}};
    const FieldPellet b{
        &mesh_body(),
        {Vec3(0, 0, thinnest - overlap) + along() * (other * Vec3::UnitZ()), turned_about_its_axis(other)}};
    EXPECT_GT(touch_field(a, b).depth, 0) << i;
  }
}

TEST(FieldKernel, StiffnessIsEvenOverFacesEdgesAndCorners) {
  // a box against a large box's face, at half a per cent of its size
  const auto floor_shape = test::mesh_body(test::box({6e-3, 6e-3, 6e-3}), 1728e-9, 12e-3);
  FieldOptions options;
  options.spacing = 0.6e-3;
  const FieldBody floor = make_field_body(*floor_shape, options);
  const Vec3 half(1.5e-3, 1.6e-3, 1.7e-3);
  const auto stiffness = [&](const Quat& rotation) {  // of W, relative to depth^2 / 2
    double reach = 0;
    for (int i = 0; i < 8; ++i)
      reach = std::max(reach, -(rotation * Vec3(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                                                i & 4 ? half.z() : -half.z()))
                                   .z());
    const double depth = 0.005 * 3e-3;
    const Touch t =
        touch_field({&box_body(), {{0.1e-3, 0.2e-3, 6e-3 + reach - depth}, rotation}}, {&floor, {}});
    return t.delta * t.delta / (depth * depth);
  };
  const double face = stiffness(Quat::Identity());
  const double edge = stiffness(Quat(Eigen::AngleAxisd(kPi / 4, Vec3::UnitX())));
  const double corner = stiffness(Quat::FromTwoVectors(Vec3(1, 1, 1).normalized(), Vec3::UnitZ()));
  std::printf("[  field   ] stiffness of a box: face %.2f, edge %.2f, corner %.2f\n", face, edge, corner);
  EXPECT_LT(std::max({face, edge, corner}) / std::min({face, edge, corner}), 5);
  EXPECT_GT(std::min({face, edge, corner}), 0.2);
}

TEST(FieldKernel, DeltaConvergesWithTheSpacing) {
  std::vector<FieldBody> bodies;
  for (const double across : {10.0, 20.0, 40.0}) {
    FieldOptions options;
    options.spacing = kD / across;
    bodies.push_back(make_field_body(*test::a38(), options));
  }
  Random random(8, Stream::test, 0);
  double error[2] = {0, 0};
  for (int i = 0; i < 60; ++i) {
    const Pair p = touching(bodies[2], bodies[2], random, 0.02 * kD);
    const double exact = touch_field(p.a, p.b).delta;
    for (std::size_t k = 0; k < 2; ++k)
      error[k] +=
          std::abs(touch_field({&bodies[k], p.a.pose}, {&bodies[k], p.b.pose}).delta / exact - 1) / 60;
  }
  EXPECT_LT(error[1], 0.6 * error[0]);
  EXPECT_LT(error[1], 0.06);
}

TEST(FieldKernel, TheGapIsNeverLargerThanTheWayToTheFirstTouch) {
  Random random(9, Stream::test, 0);
  for_pairs([&](const FieldBody& a, const FieldBody& b) {
    for (int i = 0; i < 10; ++i) {
      Pair p = touching(a, b, random, 0);
      const Vec3 away = (p.b.pose.position - p.a.pose.position).normalized();
      for (const double distance : {0.05e-3, 0.4e-3, 3e-3}) {
        FieldPellet far = p.b;
        far.pose.position += distance * away;
        double gap = -1;
        const Touch t = touch_field(p.a, far, &gap);
        if (t.delta > 0) continue;
        EXPECT_GE(gap, 0);
        EXPECT_LE(gap, distance * (1 + 1e-6) + 1e-9);
      }
    }
  });
}

TEST(FieldKernel, ANonConvexPelletHoldsAnotherInItsHollow) {
  // a ball in a square cup, touching all four walls and the floor a little
  const auto cup_shape = test::mesh_body(test::square_cup(1.79e-3, 3e-3, 0.8e-3), 50e-9, 0.8e-3);
  const FieldBody cup = make_field_body(*cup_shape);
  const FieldPellet outer{&cup, {}}, inner{&ball_body(), {{0, 0, 1.79e-3}, Quat::Identity()}};
  const Touch t = touch_field(inner, outer);
  EXPECT_NEAR(t.depth, 0.01e-3, 0.003e-3);
  EXPECT_GT(t.gradient.z(), 0.05);               // the floor pushes up
  EXPECT_LT(t.gradient.head<2>().norm(), 0.15);  // the walls balance
  const FieldPellet loose{&ball_body(), {{0, 0, 1.9e-3}, Quat::Identity()}, 0.95};
  EXPECT_EQ(touch_field(loose, outer).delta, 0);  // inside its box and bounding sphere, and clear
}

TEST(FieldKernel, SameBitsForAnyNumberOfThreads) {
  set_threads(1);
  const FieldBody one = make_field_body(*a38_mesh());
  set_threads(3);
  const FieldBody three = make_field_body(*a38_mesh());
  set_threads(1);
  Random random(10, Stream::test, 0);
  const Pair p = touching(one, one, random, 0.01 * kD);
  const Touch t = touch_field(p.a, p.b), u = touch_field({&three, p.a.pose}, {&three, p.b.pose});
  EXPECT_EQ(t.delta, u.delta);
  EXPECT_EQ(t.gradient, u.gradient);
  EXPECT_EQ(t.torque_b, u.torque_b);
}

Container cup_container() {
  Container container;
  container.kind = ContainerKind::mesh;
  container.name = "cup";
  container.radius = 10e-3;
  container.height = 30e-3;
  container.surface = test::square_cup(10e-3, 30e-3, 3e-3);
  return container;
}

TEST(FieldWall, HoldsAPelletOnItsFloorAndInItsCorner) {
  const FieldWall wall = make_field_wall(cup_container(), kD);
  const double depth = 0.01e-3;
  const FieldPellet standing{&mesh_body(), {{1e-3, 2e-3, 1.73e-3 - depth}, Quat::Identity()}};
  const Touch t = touch_container(standing, wall);
  EXPECT_NEAR(t.depth, depth, 0.02 * depth);
  EXPECT_NEAR(t.gradient.normalized().z(), 1, 1e-4);
  EXPECT_LT(t.torque_a.norm(), 0.03 * kD);
  EXPECT_LT((t.point - Vec3(1e-3, 2e-3, 0)).norm(), 0.03 * kD);
  const FieldPellet free{&mesh_body(), {{1e-3, 2e-3, 1.75e-3}, Quat::Identity()}};
  double gap = -1;
  EXPECT_EQ(touch_container(free, wall, &gap).delta, 0);
  EXPECT_LE(gap, 0.02e-3 + 1e-9);
  const FieldPellet middle{&mesh_body(), {{0, 0, 15e-3}, Quat::Identity()}};
  EXPECT_EQ(touch_container(middle, wall, &gap).delta, 0);
  EXPECT_GT(gap, 5e-3);
  const FieldPellet corner{&ball_body(), {{8.26e-3, 8.26e-3, 5e-3}, Quat::Identity()}};
  const Touch c = touch_container(corner, wall);
  EXPECT_NEAR(c.gradient.x() / c.gradient.y(), 1, 0.1);
  EXPECT_LT(c.gradient.x(), -0.3);
}

TEST(FieldWall, ForceIsTheGradientOfDelta) {
  const FieldWall wall = make_field_wall(cup_container(), kD);
  Random random(11, Stream::test, 0);
  for (int i = 0; i < 10; ++i) {
    FieldPellet p{&mesh_body(), {{8.3e-3, 2e-3, 5e-3}, random.rotation()}};
    while (touch_container(p, wall).depth < 0.01 * kD) p.pose.position.x() += 5e-6;
    const Touch t = touch_container(p, wall);
    const double step = 2e-9, angle = 2e-6;
    for (int k = 0; k < 3; ++k) {
      const auto delta = [&](double move, double turn) {
        FieldPellet q = p;
        q.pose.position += move * Vec3::Unit(k);
        q.pose = turned(q.pose, turn * Vec3::Unit(k));
        return touch_container(q, wall).delta;
      };
      EXPECT_NEAR((delta(step, 0) - delta(-step, 0)) / (2 * step), -t.gradient[k], 1e-6);
      EXPECT_NEAR((delta(0, angle) - delta(0, -angle)) / (2 * angle), -t.torque_a[k], 1e-6 * kD);
    }
    EXPECT_LT((t.torque_a + t.torque_b + p.pose.position.cross(t.gradient)).norm(), 1e-10);
  }
}

TEST(FieldWall, KeepsWithinItsMemoryOrSaysWhatItNeeds) {
  Container large = cup_container();
  large.surface = test::square_cup(0.2, 0.5, 5e-3);
  const FieldWall wall = make_field_wall(cup_container(), kD, 8e6);
  EXPECT_LT(static_cast<double>(wall.field.bytes()), 16e6);
  try {
    make_field_wall(large, kD, 8e6);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("MB"), std::string::npos);
  }
}

}  // namespace
}  // namespace packbed
