// The cylinder kernel: force is the gradient of the energy, nothing is missed, and the pair keeps its
// momentum.
#include "contact/cylinder.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "math/random.hpp"

namespace packbed {
namespace {

constexpr double kRadius = 1.71e-3, kHalfHeight = 1.73e-3;

Rod moved(const Rod& rod, const Vec3& way, const Vec3& turn) {
  Rod out = rod;
  out.centre += way;
  const double angle = turn.norm();
  if (angle > 0) out.axis = Eigen::AngleAxisd(angle, turn / angle) * rod.axis;
  return out;
}

struct RodPair {
  Rod a, b;
};

/// Random pairs pushed together until they overlap by 0.05 to 5 % of the diameter along a random direction:
/// any orientation, nearly parallel and nearly square ones in turn.
std::vector<RodPair> random_touches(unsigned count) {
  std::vector<RodPair> pairs;
  for (unsigned k = 0; pairs.size() < count; ++k) {
    Random random(3, Stream::test, k);
    Rod a{Vec3(0.01, 0.02, 0.03), random.on_sphere(), kRadius, kHalfHeight}, b = a;
    b.axis = random.on_sphere();
    if (k % 3 == 0) b.axis = (a.axis + 0.1 * random.on_sphere()).normalized();
    if (k % 3 == 1)
      b.axis = (a.axis.cross(random.on_sphere()).normalized() + 0.1 * random.on_sphere()).normalized();
    const Vec3 direction = random.on_sphere();
    double near = 0, far = 8e-3;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (near + far);
      b.centre = a.centre + middle * direction;
      (touch_cylinders(a, b).delta > 0 ? near : far) = middle;
    }
    b.centre = a.centre + (near - random.uniform(0.0005, 0.05) * 2 * kRadius) * direction;
    pairs.push_back({a, b});
  }
  return pairs;
}

/// Greatest of -separation over many directions, refined: the overlap of two convex bodies, found without the
/// kernel.
double penetration_by_directions(const Rod& a, const Rod& b) {
  const auto overlap = [&](const Vec3& n) {
    const auto half = [&](const Rod& r) {
      const double c = r.axis.dot(n);
      return r.half_height * std::abs(c) + r.radius * std::sqrt(std::max(0.0, 1 - c * c));
    };
    return half(a) + half(b) - std::abs(n.dot(b.centre - a.centre));
  };
  Random random(9, Stream::test, 0);
  Vec3 best = Vec3::UnitX();
  for (int i = 0; i < 4000; ++i) {
    const Vec3 n = random.on_sphere();
    if (overlap(n) < overlap(best)) best = n;
  }
  for (double step = 0.05; step > 1e-7; step *= 0.7)
    for (int i = 0; i < 40; ++i) {
      const Vec3 n = (best + step * random.on_sphere()).normalized();
      if (overlap(n) < overlap(best)) best = n;
    }
  return overlap(best);
}

TEST(Cylinders, ForceIsTheGradientOfTheEnergy) {
  unsigned k = 0;
  for (const RodPair& pair : random_touches(400)) {
    Random random(4, Stream::test, ++k);
    const Touch t = touch_cylinders(pair.a, pair.b);
    const Vec3 way = random.on_sphere(), turn = random.on_sphere() / kRadius;
    const Vec3 way_b = random.on_sphere(), turn_b = random.on_sphere() / kRadius;
    const double h = 1e-10;
    const double ahead =
        touch_cylinders(moved(pair.a, h * way, h * turn), moved(pair.b, h * way_b, h * turn_b)).delta;
    const double behind =
        touch_cylinders(moved(pair.a, -h * way, -h * turn), moved(pair.b, -h * way_b, -h * turn_b)).delta;
    const double found = -(t.gradient.dot(way - way_b) + t.torque_a.dot(turn) + t.torque_b.dot(turn_b));
    const double scale = t.gradient.norm() + (t.torque_a.norm() + t.torque_b.norm()) / kRadius;
    EXPECT_NEAR((ahead - behind) / (2 * h) / scale, found / scale, 1e-4) << "pair " << k;
  }
}

TEST(Cylinders, ActionIsReactionAboutAnyPoint) {
  for (const RodPair& pair : random_touches(200)) {
    const Touch t = touch_cylinders(pair.a, pair.b);
    const Vec3 sum = t.torque_a + t.torque_b + (pair.a.centre - pair.b.centre).cross(t.gradient);
    EXPECT_LT(sum.norm(), 1e-9 * kRadius * t.gradient.norm() + 1e-15);
  }
}

TEST(Cylinders, NoOverlapIsMissed) {
  // delta is zero exactly where the bodies are apart: just inside and just outside of first touch, found by
  // another way
  int inside = 0;
  for (unsigned k = 0; k < 150; ++k) {
    Random random(5, Stream::test, k);
    const Rod a{Vec3::Zero(), random.on_sphere(), kRadius, kHalfHeight};
    Rod b{Vec3::Zero(), random.on_sphere(), kRadius, kHalfHeight};
    b.centre = random.uniform(2.5e-3, 4.8e-3) * random.on_sphere();
    const double depth = penetration_by_directions(a, b);
    const double delta = touch_cylinders(a, b).delta;
    if (depth > 0.005 * 2 * kRadius) {
      EXPECT_GT(delta, 0) << "pair " << k << " overlaps by " << depth;
      ++inside;
    }
    if (depth < 0) {
      EXPECT_EQ(delta, 0) << "pair " << k << " is apart by " << -depth;
    }
    EXPECT_LE(separation(a, b), -depth + 1e-7) << "separation is a lower bound of the distance";
  }
  EXPECT_GT(inside, 30);
}

TEST(Cylinders, LevelParallelSidesAndCoaxialCapsTouch) {
  for (const double depth : {1e-5, 0.02 * 2 * kRadius, 0.05 * 2 * kRadius}) {  // and go on rising
    const Rod a{Vec3::Zero(), Vec3::UnitZ(), kRadius, kHalfHeight};
    const Rod beside{Vec3(2 * kRadius - depth, 0, 0), Vec3::UnitZ(), kRadius, kHalfHeight};
    const Rod above{Vec3(0, 0, 2 * kHalfHeight - depth), Vec3::UnitZ(), kRadius, kHalfHeight};
    for (const Rod& other : {beside, above}) {
      const Touch t = touch_cylinders(a, other);
      EXPECT_GT(t.delta, 0.6 * depth);
      EXPECT_LT(t.delta, 2 * depth);
      const Vec3 away = (a.centre - other.centre).normalized();
      EXPECT_NEAR(t.gradient.normalized().dot(away), 1, 1e-9);
      EXPECT_LT(t.torque_a.norm(), 1e-9 * kRadius);
    }
  }
}

// Poses of a settled bed in which a narrow arc, or one of two close by one another, is all or most of the
// touch.
struct FinePose {
  Vec3 apart;  // centre of b from that of a [mm]
  Vec3 a, b;   // axes
};
const std::vector<FinePose> kFinePoses = {
    {{2.892700306, -1.940725419, 2.578315485},
     {0.8941444254, 0.4477786802, -0.0000039547},
     {-0.4847788086, 0.1634777377, -0.8592232166}},
    {{1.153546054, 2.210756761, 3.950574069},
     {0.4801361683, -0.6409423291, -0.5988841212},
     {0.2784700342, -0.5196339076, 0.8077345122}},
    {{3.497566067, -1.874665744, 2.625030361},
     {0.0124275725, 0.0064535307, 0.9999019489},
     {0.9910045663, 0.0699171658, -0.1141119608}},
    {{0.864923431, 2.960315533, 3.376130409},
     {0.0690200704, -0.9976152715, -0.0000013917},
     {-0.4748149029, -0.7618398449, -0.4406255311}},
    {{4.016427024, 0.472173311, 2.275557557},
     {-0.5854937605, 0.1248596390, -0.8010038246},
     {-0.1950200827, -0.5956218872, -0.7792315027}},
    {{-0.233413555, -1.844511630, 3.328520753},
     {-0.0162156955, -0.0619024020, 0.9979504716},
     {-0.9430565520, 0.3325892421, 0.0053605720}},
    {{-0.224786820, -1.893433894, 3.341119128},
     {0.0019975411, -0.0548472956, 0.9984927561},
     {-0.9350549062, 0.3538232245, 0.0219419293}},
    {{-0.262173926, -2.669595630, 3.438622691},
     {0.0000589684, 0.0009415434, -0.9999995550},
     {0.6740180724, 0.7387148096, -0.0002610704}},
};

/// Sum of w d^16 along the four rims by many even samples, as the power of a length: no more than the
/// kernel's, which has rings and the crossing of the sides as well.
double delta_of_rims(const Rod& a, const Rod& b) {
  constexpr int kSamples = 200000;
  double sum = 0;
  const auto add_rims = [&](const Rod& owner, const Rod& other) {
    const Vec3 u = owner.axis.unitOrthogonal(), v = owner.axis.cross(u);
    for (const double end : {-1.0, 1.0})
      for (int i = 0; i < kSamples; ++i) {
        const double phi = 2 * kPi * i / kSamples;
        const Vec3 x = owner.centre + end * owner.half_height * owner.axis +
                       owner.radius * (std::cos(phi) * u + std::sin(phi) * v);
        const Vec3 y = x - other.centre;
        Vec3 slope;
        const double sine2 = 1 - std::pow(owner.axis.dot(other.axis), 2);
        sum += std::pow(depth_in_cylinder(y, other.axis, other.radius, other.half_height, slope), 16) *
               (1 + sine2 * more_at_edge(y, other.axis, other.radius, other.half_height, slope));
      }
  };
  add_rims(a, b);
  add_rims(b, a);
  return std::pow(sum / kSamples, 1.0 / 16);
}

TEST(Cylinders, NarrowArcsAreFoundByAFreshLook) {
  for (const FinePose& pose : kFinePoses) {
    const Rod a{Vec3::Zero(), pose.a.normalized(), kRadius, kHalfHeight};
    const Rod b{1e-3 * pose.apart, pose.b.normalized(), kRadius, kHalfHeight};
    const double rims = delta_of_rims(a, b);
    EXPECT_GT(rims, 1e-8);
    EXPECT_GT(touch_cylinders(a, b).delta, 0.98 * rims);
  }
}

TEST(Cylinders, FollowedPairsGiveTheSameAsAFreshLook) {
  int followed = 0;
  std::vector<Rod> moved_a;
  std::vector<RodFeatures> features;
  const std::vector<RodPair> pairs = random_touches(600);
  RodLooks looks;
  const auto compare = [&](std::uint32_t k, const Touch& t, bool lost) {
    if (lost) return;  // the caller looks afresh
    ++followed;
    const Touch fresh = touch_cylinders(moved_a[k], pairs[k].b);
    EXPECT_NEAR(t.delta, fresh.delta, 1e-5 * fresh.delta) << "pair " << k;
    EXPECT_LT((t.gradient - fresh.gradient).norm(), 1e-4 * fresh.gradient.norm()) << "pair " << k;
    EXPECT_LT((t.patch - fresh.patch).norm(), 1e-3 * fresh.patch.norm() + 1e-15) << "pair " << k;
  };
  features.resize(pairs.size());
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    Random random(6, Stream::test, k + 1);
    touch_cylinders(pairs[k].a, pairs[k].b, features[k]);
    moved_a.push_back(moved(pairs[k].a, 1e-6 * random.on_sphere(), 4e-4 * random.on_sphere()));
    if (!features[k].known) continue;
    looks.add(k, moved_a[k], pairs[k].b, features[k]);
    if (looks.full()) looks.finish(compare);
  }
  looks.finish(compare);
  EXPECT_GT(followed, 200);
}

TEST(Cylinders, NoWorkRoundAClosedPath) {
  // a circle of poses, translation and rotation together: the midpoint rule is spectral on it
  for (const RodPair& pair : random_touches(20)) {
    const Vec3 u = pair.a.axis.unitOrthogonal(), v = pair.a.axis.cross(u);
    const double size = 2e-7;
    double work = 0, largest = 0;
    const int n = 400;
    const auto at = [&](double phase) {
      return moved(pair.a, size * (std::cos(phase) * u + std::sin(phase) * v),
                   size / kRadius * (std::cos(phase) * v - std::sin(phase) * u));
    };
    for (int i = 0; i < n; ++i) {
      const double p = 2 * kPi * i / n, h = kPi / n;
      const Rod before = at(p - h), after = at(p + h);
      const Touch t = touch_cylinders(at(p), pair.b);
      const Vec3 turned = before.axis.cross(after.axis);
      work += t.delta * (t.gradient.dot(after.centre - before.centre) + t.torque_a.dot(turned));
      largest = std::max(largest, 0.5 * t.delta * t.delta);
    }
    EXPECT_LT(std::abs(work), 1e-5 * largest);
  }
}

TEST(Cylinders, StiffnessIsEvenOverKindsOfTouch) {
  // force per depth of flat, edge and corner-like touches on a floor at 0.5 % of the diameter
  double softest = 1e300, stiffest = 0;
  for (const double degrees : {0.0, 1.0, 5.0, 20.0, 45.0, 70.0, 85.0, 89.0, 90.0}) {
    const double tilt = degrees * kPi / 180, depth = 0.005 * 2 * kRadius;
    Rod rod{Vec3::Zero(), Vec3(std::sin(tilt), 0, std::cos(tilt)), kRadius, kHalfHeight};
    rod.centre.z() = kHalfHeight * std::cos(tilt) + kRadius * std::sin(tilt) - depth;
    double gap = 0;
    const Touch t = touch_floor(rod, gap);
    const double stiffness = t.delta * t.gradient.norm() / depth;
    softest = std::min(softest, stiffness);
    stiffest = std::max(stiffest, stiffness);
    EXPECT_NEAR(t.depth, depth, 0.02 * depth) << degrees;
  }
  EXPECT_LT(stiffest / softest, 5);
}

/// A cylinder whose edge has its foremost point, along `up`, at `at`: the cap there faces `tilt` away from
/// up.
Rod edge_at(const Vec3& at, const Vec3& up, const Vec3& aside, double tilt) {
  const Vec3 axis = std::cos(tilt) * up + std::sin(tilt) * aside;
  const Vec3 outward = std::sin(tilt) * up - std::cos(tilt) * aside;
  return {at - kHalfHeight * axis - kRadius * outward, axis, kRadius, kHalfHeight};
}

TEST(Cylinders, CrossingEdgesAreNoSoftSpot) {
  const double depth = 0.005 * 2 * kRadius;
  const auto stiffness = [&](const Rod& below, const Rod& above) {
    const Touch t = touch_cylinders(below, above);
    return t.delta * t.gradient.norm() / depth;
  };
  const Vec3 up = Vec3::UnitZ(), x = Vec3::UnitX();
  const double caps = stiffness({-kHalfHeight * up, up, kRadius, kHalfHeight},
                                {(kHalfHeight - depth) * up, up, kRadius, kHalfHeight});
  for (const double crossing : {30.0, 60.0, 90.0, 120.0})
    for (const double below : {20.0, 45.0, 70.0})
      for (const double above : {20.0, 45.0, 70.0}) {
        const double turn = crossing * kPi / 180;
        const Vec3 aside(std::cos(turn), std::sin(turn), 0);
        const double edges = stiffness(edge_at(Vec3::Zero(), up, x, below * kPi / 180),
                                       edge_at(-depth * up, -up, aside, above * kPi / 180));
        EXPECT_GT(edges, caps / 5) << crossing << " " << below << " " << above;
        EXPECT_LT(edges, caps) << crossing << " " << below << " " << above;
      }
}

TEST(Cylinders, FloorAndTubeForcesAreGradients) {
  for (unsigned k = 0; k < 300; ++k) {
    Random random(7, Stream::test, k);
    const bool tube = k % 2 == 1;
    Rod rod{Vec3(0, 0, random.uniform(1e-3, 2.4e-3)), random.on_sphere(), kRadius, kHalfHeight};
    if (tube) rod.centre = Vec3(random.uniform(0.0195, 0.0205), 0, 0.05);
    const auto look = [&](const Rod& r) {
      double gap = 0;
      return tube ? touch_tube(r, 0.02225, gap) : touch_floor(r, gap);
    };
    const Touch t = look(rod);
    if (t.delta < 1e-7) continue;
    const Vec3 way = random.on_sphere(), turn = random.on_sphere() / kRadius;
    const double h = 1e-10;
    const double slope =
        (look(moved(rod, h * way, h * turn)).delta - look(moved(rod, -h * way, -h * turn)).delta) / (2 * h);
    const double scale = t.gradient.norm() + t.torque_a.norm() / kRadius;
    EXPECT_NEAR(slope / scale, -(t.gradient.dot(way) + t.torque_a.dot(turn)) / scale, 1e-4) << k;
  }
}

}  // namespace
}  // namespace packbed
