#include "bed/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "math/types.hpp"

namespace packbed {
namespace {

// The wood chips of the seed paper (cases/reference/wood_chips.csv) without their last fraction.
const std::vector<double> kDiameter = {18.24e-3, 10.52e-3, 8.64e-3, 6.90e-3, 5.21e-3, 2.81e-3, 1.76e-3};
const std::vector<double> kCount = {1785, 1526, 2869, 604, 3444, 29351, 83865};
const std::vector<double> kVolume = {5.672e-3, 0.93e-3, 0.969e-3, 0.104e-3, 0.255e-3, 0.341e-3, 0.239e-3};

SizeDistribution wood_chips(SizeBasis by) {
  SizeDistribution sizes;
  sizes.law = SizeLaw::table;
  sizes.by = by;
  sizes.diameter = kDiameter;
  sizes.amount = by == SizeBasis::number ? kCount : kVolume;
  return sizes;
}

SizeDistribution law(SizeLaw law, SizeBasis by) {
  SizeDistribution sizes;
  sizes.law = law;
  sizes.by = by;
  sizes.modulus = 5e-3;
  sizes.exponent = 1.6;
  sizes.deviation = 1.4;
  sizes.smallest = 1e-3;
  sizes.largest = law == SizeLaw::gates_gaudin_schuhmann ? 5e-3 : 12e-3;
  return sizes;
}

double cube(double x) {
  return x * x * x;
}

std::uint32_t total(const std::vector<SizeClass>& classes) {
  std::uint32_t n = 0;
  for (const SizeClass& c : classes) n += c.count;
  return n;
}

TEST(Sizes, LargestRemaindersGiveEachItsQuotaRoundedDownOrUp) {
  const std::vector<double> shares = {47, 16, 15.8, 12, 6.1, 3.1};  // the textbook's parliament of ten seats
  EXPECT_EQ(largest_remainder(shares, 10), (std::vector<std::uint32_t>{5, 2, 1, 1, 1, 0}));
  for (const std::uint32_t n : {1u, 7u, 2000u, 123456u}) {
    const auto counts = largest_remainder(kCount, n);
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0u), n);
    const double sum = std::accumulate(kCount.begin(), kCount.end(), 0.0);
    for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_LT(std::abs(counts[i] - kCount[i] / sum * n), 1);
  }
}

TEST(Sizes, ATableOfCountsGivesItsCountsBack) {
  const auto classes = size_classes(wood_chips(SizeBasis::number), 123444, 18.24e-3);
  ASSERT_EQ(classes.size(), kCount.size());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    EXPECT_EQ(classes[i].count, kCount[i]);
    EXPECT_DOUBLE_EQ(classes[i].scale * 18.24e-3, kDiameter[i]);
  }
}

TEST(Sizes, VolumesOfThePapersTableMeanItsCounts) {  // its columns are rounded to three digits
  const auto by_volume = size_classes(wood_chips(SizeBasis::volume), 123444, 18.24e-3);
  for (std::size_t i = 0; i < by_volume.size(); ++i) {
    const double own = kVolume[i] / (kPi / 6 * cube(kDiameter[i]));
    EXPECT_NEAR(own / kCount[i], 1, 0.01);
    EXPECT_NEAR(by_volume[i].count / kCount[i], 1, 0.011);
  }
}

TEST(Sizes, CutOffsLeaveTheRestInProportion) {
  SizeDistribution sizes = wood_chips(SizeBasis::number);
  sizes.smallest = 8e-3;
  const auto classes = size_classes(sizes, 1785 + 1526 + 2869, 18.24e-3);
  ASSERT_EQ(classes.size(), 3u);
  EXPECT_EQ(classes[0].count, 1785u);
  EXPECT_EQ(classes[2].count, 2869u);
}

TEST(Sizes, ShareUnderIsTheLawBetweenItsCutOffs) {
  for (double d : {1.0e-3, 1.3e-3, 2.5e-3, 4.9e-3}) {
    const auto rosin = [](double x) { return 1 - std::exp(-std::pow(x / 5e-3, 1.6)); };
    EXPECT_NEAR(share_under(law(SizeLaw::rosin_rammler, SizeBasis::volume), d, SizeBasis::volume),
                (rosin(d) - rosin(1e-3)) / (rosin(12e-3) - rosin(1e-3)), 1e-6);
    const auto power = [](double x, double m) { return std::pow(x, m); };
    const SizeDistribution gates = law(SizeLaw::gates_gaudin_schuhmann, SizeBasis::volume);
    EXPECT_NEAR(share_under(gates, d, SizeBasis::volume),
                (power(d, 1.6) - power(1e-3, 1.6)) / (power(5e-3, 1.6) - power(1e-3, 1.6)), 1e-6);
    // dF ~ d^(m - 1) by volume is d^(m - 4) by number
    EXPECT_NEAR(share_under(gates, d, SizeBasis::number),
                (power(d, -1.4) - power(1e-3, -1.4)) / (power(5e-3, -1.4) - power(1e-3, -1.4)), 1e-6);
  }
}

TEST(Sizes, ALogNormalLawByNumberIsOneByVolume) {  // Hatch & Choate 1929: median times exp(3 ln^2 sigma)
  SizeDistribution number = law(SizeLaw::log_normal, SizeBasis::number), volume = number;
  volume.by = SizeBasis::volume;
  volume.modulus = number.modulus * std::exp(3 * std::pow(std::log(1.4), 2));
  for (double d : {2e-3, 4e-3, 7e-3, 11e-3}) {
    EXPECT_NEAR(share_under(number, d, SizeBasis::volume), share_under(volume, d, SizeBasis::volume), 1e-6);
    EXPECT_NEAR(share_under(number, d, SizeBasis::number), share_under(volume, d, SizeBasis::number), 1e-6);
  }
}

TEST(Sizes, PelletsOfALawFollowItWithinOneOfThemAndHaveItsVolume) {
  for (const SizeLaw kind : {SizeLaw::rosin_rammler, SizeLaw::gates_gaudin_schuhmann, SizeLaw::log_normal})
    for (const SizeBasis by : {SizeBasis::number, SizeBasis::volume})
      for (const std::uint32_t n : {1u, 10u, 3000u}) {
        const SizeDistribution sizes = law(kind, by);
        const auto classes = size_classes(sizes, n, 5e-3);
        ASSERT_EQ(total(classes), n);
        double volume = 0, last = 1e9;
        for (std::size_t i = 0; i < classes.size(); ++i) {
          const double d = classes[i].scale * 5e-3;
          EXPECT_LE(classes[i].scale, last * (1 + 1e-12));
          EXPECT_GE(d, sizes.smallest * (1 - 1e-9));
          EXPECT_LE(d, sizes.largest * (1 + 1e-9));
          const double larger = static_cast<double>(i) / n;  // share of the pellets that are larger
          if (i % (n / 5 + 1) == 0) {
            EXPECT_NEAR(share_under(sizes, d, SizeBasis::number), 1 - larger - 0.5 / n, 0.5 / n + 1e-6);
          }
          volume += cube(d);
          last = classes[i].scale;
        }
        EXPECT_NEAR(volume / (n * mean_cube(sizes)), 1, 1e-12);
      }
}

TEST(Sizes, NoClassesMeansPelletsLikeTheirShape) {
  EXPECT_EQ(smallest_scale({}), 1);
  EXPECT_EQ(largest_scale({}), 1);
  EXPECT_EQ(mean_cubed_scale({}), 1);
  const std::vector<SizeClass> classes = {{2, 1, 0.2}, {1, 3, 0.6}, {0.1, 0, 0.2}};
  EXPECT_EQ(smallest_scale(classes), 1);  // of the smallest there is none
  EXPECT_EQ(largest_scale(classes), 2);
  EXPECT_DOUBLE_EQ(mean_cubed_scale(classes), (8.0 + 3.0) / 4);
}

}  // namespace
}  // namespace packbed
