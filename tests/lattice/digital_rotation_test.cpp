// Cells that are turned: their number is kept to the last one, their shape is not.
#include "lattice/digital_rotation.hpp"

#include <gtest/gtest.h>

#include "../shapes.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

TEST(DigitalRotation, OfAQuarterTurnIsExact) {
  StampMaker maker(1e-3, 20e-3);
  const ShapePtr body = test::cylinder(27e-3, 17e-3);  // no centre of a cell lies on its surface
  const Stamp stamp = maker.make(*body, 1, Quat::Identity(), Vec3::Zero());
  const Quat quarter(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()));
  EXPECT_EQ(wear(turn_cells(stamp, Vec3::Zero(), quarter), maker.make(*body, 1, quarter, Vec3::Zero())), 0);
}

TEST(DigitalRotation, KeepsTheVolumeAndWearsTheShape) {
  StampMaker maker(1e-3, 20e-3);
  const ShapePtr body = test::cylinder(27e-3, 18e-3);
  Quat rotation = Quat::Identity();
  Stamp stamp = maker.make(*body, 1, rotation, Vec3::Zero());
  const std::int64_t count = stamp.count;
  double once = 0, last = 0;
  for (std::uint32_t n = 1; n <= 60; ++n) {
    Random random(4, Stream::test, n);
    const Quat turn(Eigen::AngleAxisd(random.uniform(0.1, 0.5), random.on_sphere()));
    rotation = (turn * rotation).normalized();
    stamp = turn_cells(stamp, Vec3::Zero(), turn);
    ASSERT_EQ(stamp.count, count) << n;
    if (n != 1 && n != 10 && n != 30 && n != 60) continue;
    last = wear(stamp, maker.make(*body, 1, rotation, Vec3::Zero()));
    RecordProperty("wear_percent_after_" + std::to_string(n), std::to_string(100 * last));
    if (n == 1) once = last;
  }
  EXPECT_LT(once, 0.1);
  EXPECT_GT(last, 2 * once);
}

}  // namespace
}  // namespace packbed
