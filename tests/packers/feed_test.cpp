#include "packers/feed.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../shapes.hpp"
#include "math/error.hpp"
#include "packers/entry.hpp"
#include "packers/layer.hpp"

namespace packbed {
namespace {

Scene a38_scene(FeedKind kind, int count) {
  Scene scene;
  scene.seed = 7;
  scene.pellets = {{test::a38(), 2410, 1}};
  scene.container.kind = ContainerKind::tube;
  scene.container.radius = 22.25e-3;
  scene.container.height = 0.12;
  scene.feed.kind = kind;
  scene.feed.count = count;
  scene.feed.drop_height = 0.1;
  return scene;
}

/// Feeds everything; what has entered falls freely and is taken out at the floor.
std::vector<Pellet> feed_all(Feeder& feeder, bool check_empty = false) {
  std::vector<Pellet> all, present;
  double last = 0;
  while (!feeder.done()) {
    const double time = feeder.next_time();
    for (Pellet& p : present) p.pose.position.z() -= 0.5 * 9.8 * (time * time - last * last);
    std::erase_if(present, [](const Pellet& p) { return p.pose.position.z() < 0; });
    last = time;
    const auto entered = feeder.enter(time, present, 0);
    EXPECT_FALSE(check_empty && entered.empty());
    present.insert(present.end(), entered.begin(), entered.end());
    all.insert(all.end(), entered.begin(), entered.end());
    if (time > 100) ADD_FAILURE() << "never done";
    if (time > 100) break;
  }
  return all;
}

bool inside_cylinder(const Shape& s, const Vec3& x) {
  return std::abs(x.z()) < s.half_height && std::hypot(x.x(), x.y()) < s.radius;
}

/// Brute force: dense points of each body's surface and axis against the other body.
bool points_overlap(const Shape& s, const Pellet& a, const Pellet& b) {
  for (int level = -6; level <= 6; ++level)
    for (int ring = 0; ring <= 4; ++ring)
      for (int i = 0; i < 48; ++i) {
        if (std::abs(level) < 6 && ring < 4 && (ring > 0 || i > 0)) continue;
        const double r = s.radius * ring / 4, angle = 2 * kPi * i / 48;
        const Vec3 x(r * std::cos(angle), r * std::sin(angle), s.half_height * level / 6);
        if (inside_cylinder(s, b.pose.to_local(a.pose.to_world(x)))) return true;
        if (inside_cylinder(s, a.pose.to_local(b.pose.to_world(x)))) return true;
      }
  return false;
}

TEST(Feed, FortyNinePelletsOfThePaperFitInOnePlaneOfTheTube) {
  Feeder feeder(a38_scene(FeedKind::layers, 49 * 5));
  for (int layer = 0; layer < 5; ++layer) {
    const auto pellets = feeder.enter(feeder.next_time(), {}, 0);
    ASSERT_EQ(pellets.size(), 49u);
    for (std::size_t i = 0; i < pellets.size(); ++i) {
      EXPECT_DOUBLE_EQ(pellets[i].pose.position.z(), 0.1);
      EXPECT_LE(pellets[i].pose.position.head<2>().norm() + test::a38()->bounding_radius, 22.25e-3 + 1e-12);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE((pellets[i].pose.position - pellets[j].pose.position).norm(),
                  2 * test::a38()->bounding_radius);
    }
  }
  EXPECT_TRUE(feeder.done());
}

TEST(Feed, ALayerTooLargeForOnePlaneTakesSeveral) {
  Scene scene = a38_scene(FeedKind::layers, 150);
  scene.feed.per_layer = 150;
  Feeder feeder(scene);
  const auto pellets = feeder.enter(0, {}, 0);
  ASSERT_EQ(pellets.size(), 150u);
  double highest = 0;
  for (std::size_t i = 0; i < pellets.size(); ++i) {
    highest = std::max(highest, pellets[i].pose.position.z());
    EXPECT_GE(pellets[i].pose.position.z(), 0.1);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((pellets[i].pose.position - pellets[j].pose.position).norm(),
                2 * test::a38()->bounding_radius);
  }
  EXPECT_LT(highest, 0.1 + 3.1 * 2 * test::a38()->bounding_radius);
}

TEST(Feed, PatternHoldsSixtyOneCirclesWhereTheHexagonOfFourRingsFits) {  // radius 4 spacings + a half
  EXPECT_EQ(layer_pattern(4.0 + 1e-6, 1.0, 1000, false).sites.size(), 61u);
  const LayerPattern loose = layer_pattern(4.0, 1.0, 7, true);  // one ring of the hexagon, as wide as it goes
  EXPECT_EQ(loose.sites.size(), 7u);
  EXPECT_NEAR(loose.pitch, 4.0, 1e-9);
}

TEST(Feed, LayersNeverOverlapAtEntryOverManyLayers) {
  Scene scene = a38_scene(FeedKind::layers, 49 * 40);
  scene.feed.interval = 0.03;  // the layer before has fallen by 4.4 mm: bounding spheres cross
  Feeder feeder(scene);
  std::vector<Pellet> present;
  double last = 0;
  int close = 0;
  while (!feeder.done() && feeder.next_time() < 10) {
    const double time = feeder.next_time();
    for (Pellet& p : present) p.pose.position.z() -= 4.9 * (time - last) * (time - last);
    std::erase_if(present, [](const Pellet& p) { return p.pose.position.z() < 0.09; });
    last = time;
    const auto entered = feeder.enter(time, present, 0);
    for (const Pellet& a : entered) {
      for (const Pellet& b : present) {
        if ((a.pose.position - b.pose.position).norm() >= 2 * test::a38()->bounding_radius) continue;
        ++close;
        EXPECT_FALSE(points_overlap(*test::a38(), a, b));
      }
    }
    present.insert(present.end(), entered.begin(), entered.end());
  }
  EXPECT_TRUE(feeder.done());
  EXPECT_GT(close, 0);  // else the test has seen nothing
}

TEST(Feed, AHandfulNeverOverlapsThoughBoundingSpheresDo) {
  Scene scene = a38_scene(FeedKind::pour, 45 * 20);
  scene.feed.per_layer = 45;
  Feeder feeder(scene);
  int close = 0, entered_all = 0;
  while (!feeder.done()) {
    const auto handful = feeder.enter(feeder.next_time(), {}, 0);
    entered_all += static_cast<int>(handful.size());
    for (std::size_t i = 0; i < handful.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double apart = (handful[i].pose.position - handful[j].pose.position).norm();
        if (apart >= 2 * test::a38()->bounding_radius) continue;
        ++close;
        EXPECT_FALSE(points_overlap(*test::a38(), handful[i], handful[j]));
      }
  }
  EXPECT_EQ(entered_all, 45 * 20);
  EXPECT_GT(close, 100);
}

TEST(Feed, FindsEveryOverlapThatSampledPointsFind) {
  const Scene scene = a38_scene(FeedKind::pour, 1);
  const OverlapTest overlap(scene.pellets);
  Random random(3, Stream::test, 0);
  int overlapping = 0;
  for (int i = 0; i < 2000; ++i) {
    Pellet a, b;
    a.pose.rotation = random.rotation();
    b.pose.rotation = random.rotation();
    b.pose.position = random.on_sphere() * random.uniform(3.0e-3, 5.0e-3);
    if (!points_overlap(*test::a38(), a, b)) continue;
    ++overlapping;
    EXPECT_TRUE(overlap.overlap(a, b));
  }
  EXPECT_GT(overlapping, 300);
}

TEST(Feed, RotationsAreUniform) {
  Scene scene = a38_scene(FeedKind::layers, 4900);
  Feeder feeder(scene);
  const auto pellets = feed_all(feeder);
  ASSERT_EQ(pellets.size(), 4900u);
  // of a uniform rotation each entry of the matrix has mean 0 and mean square 1/3; its square's variance is
  // 4/45
  Mat3 mean = Mat3::Zero(), square = Mat3::Zero();
  for (const Pellet& p : pellets) {
    const Mat3 r = p.pose.rotation.toRotationMatrix();
    mean += r / 4900;
    square += r.cwiseProduct(r) / 4900;
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 4 * std::sqrt(1.0 / 3 / 4900));
  EXPECT_LT((square.array() - 1.0 / 3).abs().maxCoeff(), 4 * std::sqrt(4.0 / 45 / 4900));
}

TEST(Feed, SameSeedSamePelletsOtherSeedOthers) {
  Scene scene = a38_scene(FeedKind::pour, 60);
  scene.feed.speed = 0.2;
  Feeder one(scene), two(scene);
  const auto a = feed_all(one), b = feed_all(two);
  scene.seed = 8;
  Feeder three(scene);
  const auto c = feed_all(three);
  ASSERT_EQ(a.size(), 60u);
  ASSERT_EQ(b.size(), 60u);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].pose.position, b[i].pose.position);
    EXPECT_EQ(a[i].pose.rotation.coeffs(), b[i].pose.rotation.coeffs());
    EXPECT_EQ(a[i].velocity, b[i].velocity);
    EXPECT_NE(a[i].pose.position, c[i].pose.position);
    EXPECT_NEAR(a[i].velocity.norm(), 0.2, 1e-12);
  }
}

TEST(Feed, APelletsRotationAndKindDependOnItsNumberOnly) {
  Scene scene = a38_scene(FeedKind::layers, 98);
  scene.pellets = {{test::a38(), 2410, 0.3}, {test::sphere(1.5e-3), 2000, 0.7}};
  Feeder by_layer(scene);
  scene.feed.kind = FeedKind::pour;
  scene.feed.per_layer = 3;
  Feeder by_handful(scene);
  const auto a = feed_all(by_layer), b = feed_all(by_handful);
  ASSERT_EQ(a.size(), b.size());
  int spheres = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].id, i);
    EXPECT_EQ(b[i].id, i);
    EXPECT_EQ(a[i].shape, b[i].shape);
    EXPECT_EQ(a[i].pose.rotation.coeffs(), b[i].pose.rotation.coeffs());
    spheres += a[i].shape == 1;
  }
  EXPECT_NEAR(spheres, 0.7 * 98, 4 * std::sqrt(98 * 0.7 * 0.3));
}

TEST(Feed, WaitsWhereThereIsNoRoomAndSaysSo) {
  for (const FeedKind kind : {FeedKind::layers, FeedKind::pour}) {
    Scene scene = a38_scene(kind, 20);
    scene.feed.per_layer = 20;
    Feeder feeder(scene);
    Pellet plug;  // a ball that fills the tube at the drop height
    plug.shape = 0;
    plug.scale = 20;
    plug.pose.position = {0, 0, 0.1};
    const std::vector<Pellet> present{plug};
    EXPECT_TRUE(feeder.enter(feeder.next_time(), present, 0).empty());
    EXPECT_TRUE(feeder.waiting());
    EXPECT_FALSE(feeder.done());
    EXPECT_DOUBLE_EQ(feeder.next_time(), 0.25 * scene.feed.interval);
    EXPECT_TRUE(feeder.enter(0.1 * scene.feed.interval, {}, 0).empty());  // before its time
    EXPECT_EQ(feeder.enter(feeder.next_time(), {}, 0).size(), 20u);
    EXPECT_FALSE(feeder.waiting());
    EXPECT_TRUE(feeder.done());
    EXPECT_TRUE(std::isinf(feeder.next_time()));
  }
}

TEST(Feed, EndsAtTheCount) {
  Feeder feeder(a38_scene(FeedKind::layers, 100));
  EXPECT_EQ(feeder.asked(), 100);
  EXPECT_EQ(feed_all(feeder, true).size(), 100u);
  EXPECT_EQ(feeder.fed(), 100);
}

TEST(Feed, EndsWithThePelletThatReachesTheMass) {
  Scene scene = a38_scene(FeedKind::layers, 0);
  scene.feed.count.reset();
  const double one = test::a38()->volume * 2410;
  scene.feed.mass = 60.5 * one;
  Feeder feeder(scene);
  EXPECT_EQ(feeder.asked(), 61);
  EXPECT_EQ(feed_all(feeder).size(), 61u);
  EXPECT_NEAR(feeder.fed_mass(), 61 * one, 1e-12);
}

TEST(Feed, EndsWhenTheSurfaceReachesTheHeight) {
  Scene scene = a38_scene(FeedKind::layers, 0);
  scene.feed.count.reset();
  scene.feed.height = 0.05;
  Feeder feeder(scene);
  EXPECT_GT(feeder.asked(), 1000);  // 0.6 of the tube up to there
  EXPECT_EQ(feeder.enter(0, {}, 0.049).size(), 49u);
  EXPECT_FALSE(feeder.done());
  EXPECT_TRUE(feeder.enter(feeder.next_time(), {}, 0.05).empty());
  EXPECT_TRUE(feeder.done());
  EXPECT_FALSE(feeder.waiting());
  EXPECT_EQ(feeder.asked(), 49);
}

TEST(Feed, DropHeightCountsFromTheBedWhenAsked) {
  Scene scene = a38_scene(FeedKind::pour, 5);
  scene.feed.above_bed = true;
  scene.feed.drop_height = 0.02;
  Feeder feeder(scene);
  for (const Pellet& p : feeder.enter(0, {}, 0.03)) EXPECT_DOUBLE_EQ(p.pose.position.z(), 0.05);
}

TEST(Feed, APelletLargerThanTheContainerIsRefused) {
  Scene scene = a38_scene(FeedKind::layers, 10);
  scene.container.radius = 2.4e-3;  // upright it would fit (1.71 mm), turned it needs 2.43 mm
  EXPECT_THROW(Feeder{scene}, InputError);
  scene.container.radius = 2.5e-3;
  scene.feed.per_layer = 1;
  Feeder feeder(scene);
  EXPECT_EQ(feeder.enter(0, {}, 0).size(), 1u);
}

TEST(Feed, FeedsWithoutEndOrIntoTheFloorOrWallAreRefused) {
  Scene scene = a38_scene(FeedKind::layers, 10);
  scene.feed.count.reset();
  EXPECT_THROW(Feeder{scene}, InputError);
  scene = a38_scene(FeedKind::layers, 10);
  scene.feed.drop_height = 2e-3;
  EXPECT_THROW(Feeder{scene}, InputError);
  scene = a38_scene(FeedKind::pour, 10);
  scene.feed.radius = 20.5e-3;
  EXPECT_THROW(Feeder{scene}, InputError);
  scene = a38_scene(FeedKind::pour, 10);
  scene.container.kind = ContainerKind::none;
  EXPECT_THROW(Feeder{scene}, InputError);
}

TEST(Feed, StaysClearOfTheWallsOfAMeshContainer) {
  Scene scene = a38_scene(FeedKind::pour, 60);
  scene.container.kind = ContainerKind::mesh;
  scene.container.radius = 10e-3;
  scene.container.surface = test::square_cup(10e-3, 0.08, 2e-3);
  scene.feed.per_layer = 4;
  scene.feed.drop_height = 0.04;
  Feeder feeder(scene);
  for (const Pellet& p : feed_all(feeder))
    EXPECT_LE(p.pose.position.head<2>().cwiseAbs().maxCoeff() + test::a38()->bounding_radius, 10e-3 + 1e-12);
  scene.feed.drop_height = 2.5e-3;  // above the floor's inner face by just enough
  EXPECT_NO_THROW(Feeder{scene});
  scene.container.surface = test::square_cup(2e-3, 0.08, 12e-3);  // the same outside, no room inside
  EXPECT_THROW(Feeder{scene}, InputError);
}

TEST(Feed, RestoredStateContinuesAsIfNothingHadHappened) {
  const Scene scene = a38_scene(FeedKind::pour, 30 * 5);
  Feeder whole(scene), first(scene), second(scene);
  const auto all = feed_all(whole);
  auto part = first.enter(0, {}, 0);
  second.restore(first.save());
  EXPECT_EQ(second.fed(), first.fed());
  while (!second.done()) {
    const auto more = second.enter(second.next_time(), {}, 0);
    part.insert(part.end(), more.begin(), more.end());
  }
  ASSERT_EQ(part.size(), all.size());
  for (std::size_t i = 0; i < part.size(); ++i)
    EXPECT_EQ(part[i].pose.rotation.coeffs(), all[i].pose.rotation.coeffs());
  EXPECT_THROW(second.restore(std::vector<std::byte>(3)), SystemError);
}

Scene two_placed(double apart) {
  Scene scene = a38_scene(FeedKind::placed, 0);
  scene.feed.count.reset();
  PlacedPellet low, high;
  low.pose.position = {0, 0, 1.73e-3};
  high.pose.position = {0, 0, 1.73e-3 + apart};
  high.velocity = {0, 0, -1};
  scene.feed.placed = {low, high};
  return scene;
}

TEST(Feed, PlacedPelletsAllEnterAtTheStartAsGiven) {
  Feeder feeder(two_placed(3.46e-3));
  EXPECT_EQ(feeder.asked(), 2);
  EXPECT_DOUBLE_EQ(feeder.next_time(), 0);
  const auto pellets = feeder.enter(0, {}, 0);
  ASSERT_EQ(pellets.size(), 2u);
  EXPECT_EQ(pellets[1].velocity, Vec3(0, 0, -1));
  EXPECT_TRUE(feeder.done());
}

TEST(Feed, PlacedPelletsThatOverlapAreRefusedWithBothNumbers) {
  Scene scene = two_placed(3.46e-3 - 1e-4);  // 2.9 % of 3.42 mm
  scene.overlap_limit = 0.01;
  try {
    Feeder feeder(scene);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("0 and 1"), std::string::npos) << error.what();
  }
  scene.pellet_contact.allowed_overlap = 0.03;
  EXPECT_NO_THROW(Feeder{scene});
  scene.pellet_contact.allowed_overlap = 0;
  for (PlacedPellet& p : scene.feed.placed) p.fixed = true;
  EXPECT_NO_THROW(Feeder{scene});
}

TEST(Feed, PlacedPelletsOutsideOrWithoutANumberAreRefused) {
  Scene scene = two_placed(5e-3);
  scene.feed.placed[0].pose.position.z() = 1.6e-3;  // 0.13 mm below the floor
  EXPECT_THROW(Feeder{scene}, InputError);
  scene = two_placed(5e-3);
  scene.feed.placed[0].pose.position.x() = 21e-3;
  EXPECT_THROW(Feeder{scene}, InputError);
  scene = two_placed(5e-3);
  scene.feed.placed[1].pose.position.y() = std::nan("");
  EXPECT_THROW(Feeder{scene}, InputError);
}

TEST(Feed, PlacedPelletsThatAreNotConvexMayReachIntoEachOther) {
  Scene scene = a38_scene(FeedKind::placed, 0);
  scene.feed.count.reset();
  const auto cup = test::mesh_body(test::square_cup(1.9e-3, 3e-3, 0.8e-3), 60e-9, 0.8e-3);
  scene.pellets = {{cup, 2000, 0.5}, {test::sphere(1.8e-3), 2000, 0.5}};
  PlacedPellet outer, inner;
  outer.pose.position = {0, 0, 1e-3};
  inner.kind = 1;
  inner.pose.position = {0, 0, 1e-3 + 1.81e-3};  // in the hollow, just clear of its floor
  scene.feed.placed = {outer, inner};
  EXPECT_NO_THROW(Feeder{scene});
  scene.feed.placed[1].pose.position.x() = 0.2e-3;  // 0.1 mm into the wall
  EXPECT_THROW(Feeder{scene}, InputError);
}

TEST(Feed, PlacedPelletsInTheWallOfAMeshContainerAreRefused) {
  Scene scene = two_placed(5e-3);
  scene.container.kind = ContainerKind::mesh;
  scene.container.radius = 10e-3;
  scene.container.surface = test::square_cup(10e-3, 0.08, 2e-3);
  EXPECT_NO_THROW(Feeder{scene});
  scene.feed.placed[1].pose.position.x() = 8.5e-3;  // the side of radius 1.71 mm reaches 0.21 mm in
  EXPECT_THROW(Feeder{scene}, InputError);
}

TEST(Feed, RadialExtentOfALyingCylinderIsThatOfItsRim) {
  const auto a = test::a38();
  Pose lying{{3e-3, 0, 0}, Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()))};  // axis along y
  EXPECT_NEAR(radial_extent(*a, 1, lying), std::hypot(3e-3 + a->radius, a->half_height), 1e-12);
  EXPECT_NEAR(lowest_point(*a, 1, lying), -a->radius, 1e-12);
  Random random(5, Stream::test, 1);
  for (int i = 0; i < 200; ++i) {  // never below, and within the sampling's error above, of dense rim points
    const Pose pose{random.on_sphere() * random.uniform(0, 5e-3), random.rotation()};
    double dense = 0;
    for (int k = 0; k < 4000; ++k) {
      const double t = 2 * kPi * k / 2000;
      const Vec3 x = pose.to_world(
          {a->radius * std::cos(t), a->radius * std::sin(t), k < 2000 ? a->half_height : -a->half_height});
      dense = std::max(dense, std::hypot(x.x(), x.y()));
    }
    EXPECT_GE(radial_extent(*a, 1, pose), dense - 1e-12);
    EXPECT_LE(radial_extent(*a, 1, pose), dense + 1e-8);
  }
}

}  // namespace
}  // namespace packbed
