// Feeding of pellets of many sizes, and the lattice start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "../shapes.hpp"
#include "math/error.hpp"
#include "packers/feed.hpp"

namespace packbed {
namespace {

/// 150 spheres of 8, 6 and 3 mm in a tube of 60 mm.
Scene sized_scene(FeedKind kind) {
  Scene scene;
  scene.seed = 11;
  PelletKind spheres{test::sphere(4e-3), 500, 1};
  spheres.sizes = {{1, 20, 0}, {0.75, 40, 0}, {0.375, 90, 0}};
  scene.pellets = {spheres};
  scene.container.radius = 30e-3;
  scene.container.height = 0.3;
  scene.feed.kind = kind;
  scene.feed.count = 150;
  scene.feed.per_layer = 12;
  scene.feed.drop_height = 0.2;
  return scene;
}

std::vector<Pellet> fed(const Scene& scene) {
  Feeder feeder(scene);
  std::vector<Pellet> all;
  while (!feeder.done() && feeder.next_time() < 100) {
    const auto entered = feeder.enter(feeder.next_time(), {}, 0);
    for (std::size_t i = 0; i < entered.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE((entered[i].pose.position - entered[j].pose.position).norm(),
                  4e-3 * (entered[i].scale + entered[j].scale) * (1 - 1e-9));
    all.insert(all.end(), entered.begin(), entered.end());
  }
  EXPECT_EQ(feeder.fed(), 150);
  EXPECT_NEAR(feeder.fed_mass(), 500 * 4 * kPi / 3 * 64e-9 * (20 + 40 * 0.421875 + 90 * 0.052734375), 1e-15);
  return all;
}

TEST(FeedSizes, TotalsAreExactAndTheOrderBelongsToTheSeed) {
  const auto layers = fed(sized_scene(FeedKind::layers)), handfuls = fed(sized_scene(FeedKind::pour)),
             lattice = fed(sized_scene(FeedKind::lattice)), cloud = fed(sized_scene(FeedKind::scatter));
  std::map<double, int> count;
  for (const Pellet& p : layers) ++count[p.scale];
  EXPECT_EQ(count, (std::map<double, int>{{1, 20}, {0.75, 40}, {0.375, 90}}));
  for (std::size_t i = 0; i < 150; ++i) {
    EXPECT_EQ(layers[i].id, i);
    EXPECT_EQ(layers[i].scale, handfuls[i].scale);
    EXPECT_EQ(layers[i].scale, lattice[i].scale);
    EXPECT_EQ(layers[i].scale, cloud[i].scale);
  }
  Scene other = sized_scene(FeedKind::lattice);
  other.seed = 12;
  const auto another = fed(other);
  EXPECT_TRUE(std::any_of(another.begin(), another.end(),
                          [&](const Pellet& p) { return p.scale != lattice[p.id].scale; }));
}

TEST(FeedSizes, SizesAreMixedAtRandom) {  // rank of a size against the order of feeding: no correlation
  const auto pellets = fed(sized_scene(FeedKind::lattice));
  double early = 0;
  for (const Pellet& p : pellets) early += p.scale > 0.9 && p.id < 75;
  // 20 large ones drawn without return from 150: hypergeometric, mean 10, variance 20/4 (130/149)
  EXPECT_NEAR(early, 10, 4 * std::sqrt(5.0 * 130 / 149));
}

TEST(FeedSizes, TheLatticeFillsPlanesUpwardsAllAtTheStart) {
  Scene scene = sized_scene(FeedKind::lattice);
  scene.feed.speed = 0.3;
  Feeder feeder(scene);
  EXPECT_EQ(feeder.next_time(), 0);
  EXPECT_EQ(feeder.asked(), 150);
  const auto pellets = feeder.enter(0, {}, 0);
  EXPECT_TRUE(feeder.done());
  ASSERT_EQ(pellets.size(), 150u);
  std::map<long, int> planes;
  Vec3 least = Vec3::Zero(), most = Vec3::Zero();
  for (const Pellet& p : pellets) {
    const Vec3 x = p.pose.position / 8e-3;  // sites are 8 mm apart, about the axis, from 200 mm upwards
    ++planes[std::lround(x.z() - 25)];
    EXPECT_NEAR(std::abs(x.x() - std::round(x.x())), std::abs(x.y() - std::round(x.y())), 1e-9);
    EXPECT_NEAR(x.z(), std::round(x.z()), 1e-9);
    EXPECT_LE(p.pose.position.head<2>().norm() + 4e-3, 30e-3 + 1e-9);
    least = least.cwiseMin(p.velocity);
    most = most.cwiseMax(p.velocity);
  }
  const int full = planes[0];
  for (int k = 0; k < static_cast<int>(planes.size()) - 1; ++k) EXPECT_EQ(planes[k], full);
  EXPECT_EQ(planes[static_cast<long>(planes.size()) - 1], 150 - full * (static_cast<int>(planes.size()) - 1));
  for (int d = 0; d < 3; ++d) {
    EXPECT_GE(least[d], -0.3);
    EXPECT_LT(least[d], -0.27);
    EXPECT_LE(most[d], 0.3);
    EXPECT_GT(most[d], 0.27);
  }
}

TEST(FeedSizes, SpacingIsKeptAndNeverLessThanTheLargest) {
  Scene scene = sized_scene(FeedKind::lattice);
  scene.feed.spacing = 10e-3;
  Feeder feeder(scene);
  for (const Pellet& p : feeder.enter(0, {}, 0)) {
    const double level = (p.pose.position.z() - 0.2) / 10e-3;
    EXPECT_NEAR(level, std::round(level), 1e-9);
  }
  scene.feed.spacing = 7.9e-3;
  EXPECT_THROW(Feeder{scene}, InputError);
  scene.feed.spacing = 0;
  scene.feed.count = 149;  // does not belong to these sizes
  EXPECT_THROW(Feeder{scene}, InputError);
  scene = sized_scene(FeedKind::lattice);
  scene.pellets[0].sizes[0].scale = 8;  // 64 mm in a tube of 60 mm
  EXPECT_THROW(Feeder{scene}, InputError);
}

TEST(FeedSizes, ACloudIsAsThinAsAskedAndNoDenserThanItCanBe) {
  Scene scene = sized_scene(FeedKind::scatter);
  for (const double density : {0.05, 0.3}) {
    scene.feed.cloud_density = density;
    double low = 1, high = 0, volume = 0;
    for (const Pellet& p : fed(scene)) {
      const double radius = 4e-3 * p.scale, across = p.pose.position.head<2>().norm();
      EXPECT_LE(across + radius, 30e-3 + 1e-9);
      low = std::min(low, p.pose.position.z() - radius);
      high = std::max(high, p.pose.position.z() + radius);
      volume += 4 * kPi / 3 * std::pow(radius, 3);
    }
    const double height = volume / (kPi * 30e-3 * 30e-3 * density);
    EXPECT_GE(low, 0.196 - 1e-9);
    EXPECT_LE(high, 0.196 + height + 1e-9);
    EXPECT_GT(high - low, 0.9 * height);
    EXPECT_LE(Feeder(scene).highest(), 0.196 + height + 1e-9);
  }
  scene.feed.cloud_density = 0.6;
  Feeder feeder(scene);
  EXPECT_THROW(feeder.enter(0, {}, 0), InputError);
}

TEST(FeedSizes, ALayerOfManySizesStandsInOnePlane) {
  for (const Pellet& p : fed(sized_scene(FeedKind::layers)))
    EXPECT_LE(p.pose.position.head<2>().norm() + 4e-3 * p.scale, 30e-3 + 1e-9);
}

}  // namespace
}  // namespace packbed
