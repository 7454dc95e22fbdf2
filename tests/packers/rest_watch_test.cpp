// When is a bed at rest?
#include "packers/rest_watch.hpp"

#include <gtest/gtest.h>

namespace packbed {
namespace {

Stepping limits() {
  Stepping s;
  s.rest_speed = s.rest_force = s.rest_drift = 0.1;
  s.rest_rollers = 0.01;
  return s;
}

/// Of a hundred pellets of unit size so many roll, and all are out of balance by `unbalanced`.
void look(RestWatch& watch, int rolling, double unbalanced = 0) {
  watch.anchor.assign(100, Vec3::Zero());
  RestLook look(watch);
  for (std::size_t i = 0; i < 100; ++i) {
    const double way = static_cast<int>(i) < rolling ? 1.0 : 0.05;
    look.add(i, 0.25 * way * way, unbalanced, Vec3(0, way, 0), 1.0);
  }
  look.finish(limits(), 1.0, false);
}

TEST(RestWatch, LeavesOutTheFewThatRoll) {
  RestWatch watch;
  look(watch, 1);
  EXPECT_TRUE(watch.at_rest);
  EXPECT_EQ(watch.rollers, 1);
  EXPECT_DOUBLE_EQ(watch.drift, 0.05);
  EXPECT_NEAR(watch.speed, 0.025, 1e-12);  // that of the others alone
  EXPECT_EQ(watch.anchor[0], Vec3(0, 1, 0));
  look(watch, 2);
  EXPECT_FALSE(watch.at_rest);
  EXPECT_DOUBLE_EQ(watch.drift, 1);
  look(watch, 0, 0.2);
  EXPECT_FALSE(watch.at_rest);
}

TEST(RestWatch, AsksOnceMoreWithNobodyAsleep) {
  RestWatch watch;
  look(watch, 2);
  EXPECT_FALSE(ask_once_more(watch));
  look(watch, 0);
  EXPECT_TRUE(ask_once_more(watch));  // all wake now
  EXPECT_FALSE(watch.at_rest);
  look(watch, 0);
  EXPECT_FALSE(ask_once_more(watch));
  EXPECT_TRUE(watch.at_rest);
}

TEST(RestWatch, GivesUpOnABedThatMovesOnAwake) {
  RestWatch watch;
  look(watch, 0);
  ASSERT_TRUE(ask_once_more(watch));
  int windows = 0;
  while (watch.last_watch > 0 && windows < 100) {
    look(watch, 2);
    EXPECT_FALSE(ask_once_more(watch));
    ++windows;
  }
  EXPECT_EQ(windows, 5);
  look(watch, 0);  // asleep again, and asked anew
  EXPECT_TRUE(ask_once_more(watch));
}

}  // namespace
}  // namespace packbed
