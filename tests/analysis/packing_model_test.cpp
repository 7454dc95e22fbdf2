// The linear packing model where its answer is known.
#include "analysis/packing_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace packbed {
namespace {

constexpr double kAlone = 0.39;

TEST(PackingModel, EqualSpheresFillWhatTheyFillAlone) {
  EXPECT_NEAR(mixture_porosity({{1e-3, 1}}, kAlone), kAlone, 1e-15);
  EXPECT_NEAR(mixture_porosity({{1e-3, 0.3}, {1e-3, 0.7}}, kAlone), kAlone, 1e-15);
  EXPECT_TRUE(std::isnan(mixture_porosity({}, kAlone)));
}

TEST(PackingModel, FewTinySpheresFillPoresAndFewHugeOnesReplaceBed) {
  constexpr double kTiny = 1e-9, kFew = 0.1;
  EXPECT_NEAR(mixture_porosity({{1, 1 - kFew}, {kTiny, kFew}}, kAlone), 1 - (1 - kAlone) / (1 - kFew), 1e-7);
  EXPECT_NEAR(mixture_porosity({{1, kFew}, {kTiny, 1 - kFew}}, kAlone),
              1 - 1 / ((1 - kFew) / (1 - kAlone) + kFew), 1e-7);
}

TEST(PackingModel, AMixtureIsDensestWhenTheFinesJustFillThePores) {
  constexpr double kTiny = 1e-9;
  const double full = kAlone / (1 + kAlone);  // share of fines at which both ends meet
  const double least = mixture_porosity({{1, 1 - full}, {kTiny, full}}, kAlone);
  EXPECT_NEAR(least, kAlone * kAlone, 1e-7);
  for (const double more : {-0.05, 0.05})
    EXPECT_GT(mixture_porosity({{1, 1 - full - more}, {kTiny, full + more}}, kAlone), least);
}

TEST(PackingModel, TheOrderAndTheUnitOfTheSizesDoNotMatter) {
  const double porosity = mixture_porosity({{18e-3, 0.6}, {10e-3, 0.3}, {2e-3, 0.1}}, kAlone);
  EXPECT_NEAR(mixture_porosity({{2, 0.1}, {18, 0.6}, {10, 0.3}}, kAlone), porosity, 1e-14);
  EXPECT_LT(porosity, kAlone);
}

}  // namespace
}  // namespace packbed
