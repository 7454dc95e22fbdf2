#include "analysis/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random.hpp"

namespace packbed {
namespace {

Profile line(double from, double to, int n, double slope, double lift) {
  Profile p;
  for (int i = 0; i < n; ++i) {
    const double x = from + (to - from) * i / (n - 1);
    p.x_dp.push_back(x);
    p.density.push_back(slope * x + lift);
  }
  return p;
}

TEST(Compare, RmsOfTwoLinesIsTheIntegralsRoot) {
  // two lines that differ by x on [0, 1]: the mean of x^2 is 1/3
  EXPECT_NEAR(rms_distance(line(0, 1, 2001, 0, 0.5), line(0, 1, 17, 1, 0.5)), std::sqrt(1.0 / 3), 1e-3);
  EXPECT_NEAR(rms_distance(line(0, 1, 50, 2, 0), line(0, 1, 50, 2, 0)), 0, 1e-15);
  // only the common part counts
  EXPECT_NEAR(rms_distance(line(0, 2, 401, 0, 0), line(1, 2, 7, 0, 0.25)), 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(rms_distance(line(0, 1, 5, 0, 0), line(2, 3, 5, 0, 0))));
}

TEST(Compare, KolmogorovSmirnovOfSmallSamplesByHand) {
  EXPECT_DOUBLE_EQ(ks_distance({1, 2, 3}, {1, 2, 3}).distance, 0);
  EXPECT_DOUBLE_EQ(ks_distance({1, 2}, {3, 4}).distance, 1);
  // after 2: 2/2 against 1/4
  EXPECT_DOUBLE_EQ(ks_distance({1, 2}, {1.5, 3, 4, 5}).distance, 0.75);
  EXPECT_DOUBLE_EQ(ks_distance({NAN, 1, 2}, {2, 1, NAN}).distance, 0);
  EXPECT_TRUE(std::isnan(ks_distance({}, {1}).distance));
}

// Smirnov's limit is what one case of twenty exceeds.
TEST(Compare, SamplesOfOneDistributionExceedTheLimitOneTimeInTwenty) {
  int over = 0;
  constexpr int kTrials = 2000;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    Random random(1, Stream::test, trial);
    std::vector<double> a(200), b(300);
    for (double& x : a) x = random.uniform();
    for (double& x : b) x = random.uniform();
    const KolmogorovSmirnov ks = ks_distance(a, b);
    over += ks.distance > ks.limit_5_percent;
  }
  EXPECT_NEAR(static_cast<double>(over) / kTrials, 0.045, 0.02);  // discrete samples reach a little less
}

}  // namespace
}  // namespace packbed
