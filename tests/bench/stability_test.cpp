// The quick ones of `packbed bench stability`.
#include "bench/stability.hpp"

#include <gtest/gtest.h>

namespace packbed::bench {
namespace {

void expect_pass(const Verdict& v) {
  EXPECT_TRUE(v.passed) << v.test << "\n  asked: " << v.asked << "\n  found: " << v.found;
}

TEST(Stability, CylinderStrikesAPlaneAsARigidBody) {
  for (const double degrees : {20.0, 35.0, 60.0, 75.0})
    for (const double friction : {0.0, 0.1, 0.3}) expect_pass(oblique_rim_impact(degrees, friction));
}

// Three equal cylinders: the upper pair of contacts needs tan 15 degrees, the floor a third of it.
TEST(Stability, PyramidStandsJustAboveTheFrictionThatItNeedsAndFallsJustBelow) {
  expect_pass(pyramid_stands_or_falls(0.29, 0.5));
  expect_pass(pyramid_stands_or_falls(0.25, 0.5));
  expect_pass(pyramid_stands_or_falls(0.5, 0.1));
  expect_pass(pyramid_stands_or_falls(0.5, 0.08));
}

TEST(Stability, ForcesStayFiniteAtDegeneratePoses) {
  expect_pass(forces_stay_finite("cylinder", 3000));
  expect_pass(forces_stay_finite("field", 500));
}

TEST(Stability, DeepStartIsRefusedOrGentle) {
  expect_pass(deep_start_is_gentle());
}

TEST(Stability, RingsBounceOff) {
  expect_pass(rings_bounce_off(20));
}

}  // namespace
}  // namespace packbed::bench
