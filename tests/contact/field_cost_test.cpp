// The field kernel beside the analytic one on the same pellet: how alike, and at what cost. Prints the table
// of docs/field_kernel.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

#include "../shapes.hpp"
#include "contact/cylinder.hpp"
#include "contact/field.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

constexpr double kD = 3.42e-3;

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Rod rod_at(const Pose& pose) {
  return {pose.position, pose.rotation * Vec3::UnitZ(), 1.71e-3, 1.73e-3};
}

struct PosePair {
  Pose a, b;
};

/// Random pairs whose greatest depth is `depth` for the cylinder kernel.
std::vector<PosePair> random_pairs(int count, double depth) {
  Random random(2, Stream::test, 0);
  std::vector<PosePair> pairs;
  for (int i = 0; i < count; ++i) {
    PosePair p{{Vec3::Zero(), random.rotation()}, {Vec3::Zero(), random.rotation()}};
    const Vec3 direction = random.on_sphere();
    double low = 2e-3, high = 5.2e-3;
    for (int k = 0; k < 50; ++k) {
      p.b.position = 0.5 * (low + high) * direction;
      (touch_cylinders(rod_at(p.a), rod_at(p.b)).depth > depth ? low : high) = 0.5 * (low + high);
    }
    pairs.push_back(p);
  }
  return pairs;
}

struct Likeness {
  double mean = 0, deviation = 0, least = 1e9;  // of delta over that of the cylinder kernel
  double angle = 0;                             // mean between the two forces [degrees]
  int missed = 0;
};

Likeness compare(const FieldBody& body, const std::vector<PosePair>& pairs) {
  Likeness like;
  double squares = 0;
  int n = 0;
  for (const PosePair& p : pairs) {
    const Touch field = touch_field({&body, p.a}, {&body, p.b});
    const Touch exact = touch_cylinders(rod_at(p.a), rod_at(p.b));
    if (!(field.delta > 0)) {
      ++like.missed;
      continue;
    }
    const double ratio = field.delta / exact.delta;
    const double cosine = field.gradient.normalized().dot(exact.gradient.normalized());
    like.mean += ratio;
    squares += ratio * ratio;
    like.least = std::min(like.least, ratio);
    like.angle += std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / kPi;
    ++n;
  }
  like.mean /= n;
  like.angle /= n;
  like.deviation = std::sqrt(std::max(0.0, squares / n - like.mean * like.mean));
  return like;
}

template <class Touching>
double nanoseconds(const std::vector<PosePair>& pairs, double apart, const Touching& touching) {
  std::vector<PosePair> moved = pairs;
  for (PosePair& p : moved) p.b.position += apart * p.b.position.normalized();
  constexpr int kRepeats = 20;
  double best = 1e9, sum = 0;
  for (int round = 0; round < 3; ++round) {
    const double start = cpu_seconds();
    for (int k = 0; k < kRepeats; ++k)
      for (const PosePair& p : moved) sum += touching(p);
    best = std::min(best, cpu_seconds() - start);
  }
  EXPECT_GE(sum, 0);
  return best * 1e9 / kRepeats / static_cast<double>(pairs.size());
}

std::shared_ptr<Shape> a38_mesh() {
  return test::mesh_body(test::prism(1.71e-3, 1.73e-3, 48), test::a38()->volume, kD);
}

TEST(FieldCost, AgainstTheSpacingOfThePoints) {
  const std::vector<PosePair> pairs = random_pairs(300, 0.005 * kD);
  std::printf("[ field    ] cylinder kernel: %.0f ns\n", nanoseconds(pairs, 0, [](const PosePair& p) {
                return touch_cylinders(rod_at(p.a), rod_at(p.b)).delta;
              }));
  std::printf(
      "[ field    ] points D/  points  delta field/cylinder   least  missed  angle  touching  0.1 mm  0.5 mm "
      "apart\n");
  double first_angle = 0;
  for (const double across : {8.0, 11.0, 14.0, 20.0, 28.0}) {
    FieldOptions options;
    options.spacing = test::a38()->equivalent_diameter() / across;
    const FieldBody body = make_field_body(*a38_mesh(), options);
    const Likeness like = compare(body, pairs);
    const auto touching = [&](const PosePair& p) { return touch_field({&body, p.a}, {&body, p.b}).delta; };
    std::printf("[ field    ] %9.0f %7zu   %8.3f +- %.3f      %.3f %6d %6.2f %6.0f ns %5.0f ns %5.0f ns\n",
                across, body.points.size(), like.mean, like.deviation, like.least, like.missed, like.angle,
                nanoseconds(pairs, 0, touching), nanoseconds(pairs, 0.1e-3, touching),
                nanoseconds(pairs, 0.5e-3, touching));
    if (first_angle == 0) first_angle = like.angle;
  }
}

TEST(FieldKernel, FollowsTheCylinderKernelOnItsMesh) {
  // deeper at an edge: the distance from a mesh is the lesser of those from its faces, the cylinder's smooth
  // depth is less than both
  const FieldBody body = make_field_body(*a38_mesh());
  for (const double depth : {0.005 * kD, 0.02 * kD}) {
    const Likeness like = compare(body, random_pairs(300, depth));
    EXPECT_EQ(like.missed, 0);
    EXPECT_NEAR(like.mean, 0.83, 0.14);  // the cylinder kernel counts a point touch for more (see touch.hpp)
    EXPECT_LT(like.deviation, 0.2);
    EXPECT_LT(like.angle, 3);
  }
}

TEST(FieldKernel, FollowsTheCylinderKernelOnItsExactSurface) {  // no mesh: analytic field, sampled surface
  const FieldBody body = make_field_body(*test::a38());
  for (const double depth : {0.005 * kD, 0.02 * kD}) {
    const Likeness like = compare(body, random_pairs(300, depth));
    EXPECT_EQ(like.missed, 0);
    EXPECT_NEAR(like.mean, 0.71, 0.1);  // the cylinder kernel counts crossing edges for more (see rod.hpp)
    EXPECT_LT(like.deviation, 0.2);
    EXPECT_LT(like.angle, 3);
  }
}

}  // namespace
}  // namespace packbed
