#include "math/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace packbed {
namespace {

using Words4 = std::array<std::uint32_t, 4>;

// Known answers of the reference implementation (Salmon, Moraes, Dror & Shaw, SC 2011, Random123
// kat_vectors).
TEST(Philox, GivesTheKnownAnswersOfItsAuthors) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words4{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox4x32({ones, ones, ones, ones}, {ones, ones}),
            (Words4{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words4{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, DependsOnSeedStreamBodyAndEventOnly) {
  const auto first = [](std::uint64_t seed, Stream stream, std::uint32_t body, std::uint32_t event) {
    Random random(seed, stream, body, event);
    return std::array<double, 3>{random.uniform(), random.uniform(), random.normal()};
  };
  const auto same = first(7, Stream::test, 3, 2);
  EXPECT_EQ(same, first(7, Stream::test, 3, 2));
  EXPECT_NE(same, first(8, Stream::test, 3, 2));
  EXPECT_NE(same, first(7 + (1ULL << 32), Stream::test, 3, 2));  // the upper half of the seed counts
  EXPECT_NE(same, first(7, Stream::feed_shape, 3, 2));
  EXPECT_NE(same, first(7, Stream::test, 4, 2));
  EXPECT_NE(same, first(7, Stream::test, 3, 3));
}

// Bounds of five standard errors: a right generator fails once in two million seeds, and this seed is fixed.
TEST(Random, UniformHasTheMomentsOfTheUniformLaw) {
  constexpr int n = 200000;
  Random random(1, Stream::test, 0);
  double sum = 0, squares = 0, lag = 0, before = 0.5;
  std::array<int, 64> bins{};
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
    lag += (u - 0.5) * (before - 0.5);
    before = u;
    ++bins[static_cast<std::size_t>(u * 64)];
  }
  EXPECT_NEAR(sum / n, 1.0 / 2, 5 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(squares / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / n));
  EXPECT_NEAR(lag / n, 0.0, 5.0 / 12 / std::sqrt(n));
  double chi2 = 0;
  for (const int count : bins) chi2 += (count - n / 64.0) * (count - n / 64.0) / (n / 64.0);
  EXPECT_NEAR(chi2, 63, 5 * std::sqrt(2 * 63.0));
}

TEST(Random, UniformBetweenLimitsStaysBetweenThem) {
  Random random(1, Stream::test, 1);
  double low = 1, high = -1;
  for (int i = 0; i < 10000; ++i) {
    const double u = random.uniform(-0.25, 0.75);
    low = std::min(low, u);
    high = std::max(high, u);
  }
  EXPECT_GE(low, -0.25);
  EXPECT_LT(low, -0.248);
  EXPECT_LT(high, 0.75);
  EXPECT_GT(high, 0.748);
}

TEST(Random, NormalHasTheMomentsOfTheNormalLaw) {
  constexpr int n = 200000;
  Random random(1, Stream::test, 2);
  double sum = 0, squares = 0, cubes = 0, fourths = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    cubes += x * x * x;
    fourths += x * x * x * x;
  }
  EXPECT_NEAR(sum / n, 0, 5 * std::sqrt(1.0 / n));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(cubes / n, 0, 5 * std::sqrt(15.0 / n));
  EXPECT_NEAR(fourths / n, 3, 5 * std::sqrt(96.0 / n));
}

TEST(Random, DirectionsAreIsotropic) {
  constexpr int n = 100000;
  Random random(1, Stream::test, 3);
  Vec3 mean = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (int i = 0; i < n; ++i) {
    const Vec3 u = random.on_sphere();
    ASSERT_NEAR(u.norm(), 1, 1e-14);
    mean += u / n;
    second += u * u.transpose() / n;
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5 * std::sqrt(1.0 / 3 / n));
  EXPECT_LT((second - Mat3::Identity() / 3).cwiseAbs().maxCoeff(), 5 * std::sqrt(4.0 / 45 / n));
}

// Uniform on SO(3): each column of the matrix is isotropic, and the angle of turn has the density (1 - cos a)
// / pi.
TEST(Random, RotationsAreUniform) {
  constexpr int n = 100000;
  Random random(1, Stream::test, 4);
  Mat3 mean = Mat3::Zero();
  Mat3 squares = Mat3::Zero();
  double angle = 0, trace2 = 0;
  for (int i = 0; i < n; ++i) {
    const Quat q = random.rotation();
    ASSERT_NEAR(q.norm(), 1, 1e-14);
    const Mat3 m = q.toRotationMatrix();
    mean += m / n;
    squares += m.cwiseProduct(m) / n;
    angle += 2 * std::acos(std::min(1.0, std::abs(q.w()))) / n;
    trace2 += m.trace() * m.trace() / n;
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5 * std::sqrt(1.0 / 3 / n));
  EXPECT_LT((squares - Mat3::Constant(1.0 / 3)).cwiseAbs().maxCoeff(), 5 * std::sqrt(4.0 / 45 / n));
  // mean of a over (1 - cos a) / pi on [0, pi] is pi / 2 + 2 / pi; its standard deviation is below 0.65
  EXPECT_NEAR(angle, kPi / 2 + 2 / kPi, 5 * 0.65 / std::sqrt(n));
  EXPECT_NEAR(trace2, 1, 5 * std::sqrt(2.0 / n));  // mean of the squared character, fourth moment 3
}

}  // namespace
}  // namespace packbed
