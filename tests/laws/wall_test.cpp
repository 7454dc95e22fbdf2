// Thin walls: rings that strike each other edge on do not pass through one another, and what would is refused
// or ends the run with words.
#include <gtest/gtest.h>

#include "laws/law.hpp"
#include "math/error.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

using namespace law;

constexpr double kOuter = 6e-3, kInner = 5e-3, kLength = 4e-3;  // [m]; walls of 0.5 mm

ShapePtr thin_ring() {
  static const ShapePtr shape = make_ring("ring", kOuter, kInner, kLength);
  return shape;
}

/// Free space, stiffness found from the speeds.
Scene rings() {
  Scene s = scene(ContainerKind::none, thin_ring());
  set_contact(s, 0.3, 0.2);
  s.pellet_contact.stiffness = s.wall_contact.stiffness = 0;
  return s;
}

/// Linking number of the middle circles of two rings' walls, at half their height, by the crossings of one
/// with the disc of the other. Apart it is 0; it changes when, and only when, wall passes through wall.
int linking(const Pellet& a, const Pellet& b) {
  constexpr int kSides = 720;
  const double radius = 0.25 * (kOuter + kInner);
  const auto at = [&](int i) {
    const double angle = 2 * kPi * i / kSides;
    const Vec3 x = b.pose.to_world(radius * Vec3(std::cos(angle), std::sin(angle), 0));
    return Vec3(a.pose.rotation.conjugate() * (x - a.pose.position));
  };
  int crossings = 0;
  Vec3 last = at(0);
  for (int i = 1; i <= kSides; ++i) {
    const Vec3 next = at(i);
    if ((last.z() < 0) != (next.z() < 0)) {
      const Vec3 x = last + (next - last) * (last.z() / (last.z() - next.z()));
      if (x.head<2>().norm() < radius) crossings += next.z() > 0 ? 1 : -1;
    }
    last = next;
  }
  return crossings;
}

/// Rings in random poses that fly edge on at a fixed one at 5 m/s; how many have passed through its wall.
int passed_through(int poses) {
  Scene s = rings();
  const double reach = thin_ring()->bounding_radius, speed = 5;
  for (int i = 0; i < poses; ++i) {
    Random random(1, Stream::test, static_cast<std::uint32_t>(i));
    const Vec3 at(0.05 * (i % 100), 0.05 * (i / 100), 0);
    place(s, at, random.rotation()).fixed = true;
    const Vec3 along = random.on_sphere(), aside = random.on_sphere().cross(along);
    // the axis square to the way: the edge goes first
    const Quat turn = Quat::FromTwoVectors(Vec3::UnitX(), along) *
                      Quat(Eigen::AngleAxisd(random.uniform(0, 2 * kPi), Vec3::UnitX()));
    PlacedPellet& flying = place(s, at - 2.05 * reach * along + 0.7 * reach * aside, turn);
    flying.velocity = speed * along;
  }
  const Course r = run(s, 2 * reach / speed, 0.02 * reach / speed);
  int through = 0, hit = 0;
  for (std::size_t i = 0; i < s.feed.placed.size(); i += 2) {
    bool linked = false;
    for (const Frame& f : r.frames) linked |= linking(f.pellets[i], f.pellets[i + 1]) != 0;
    through += linked;
    hit += (r.end(i + 1).velocity - r.frames.front().pellets[i + 1].velocity).norm() > 0.1 * speed;
  }
  EXPECT_GT(hit, poses / 3);
  EXPECT_LT(r.result.record.overlap.peak, 0.3);
  return through;
}

TEST(ThinWalls, TwoRingsOfAChainAreLinked) {  // the meter of the tests below
  Pellet a, b;
  b.pose = {Vec3(0.5 * kOuter, 0, 0), lying()};
  EXPECT_NE(linking(a, b), 0);
  b.pose.position.x() = 1.5 * kOuter;
  EXPECT_EQ(linking(a, b), 0);
}

TEST(ThinWalls, StopARingOnItsEdge) {
  EXPECT_EQ(passed_through(100), 0);
}

TEST(LongThinWalls, StopARingOnItsEdgeInTenThousandPoses) {
  EXPECT_EQ(passed_through(10000), 0);
}

TEST(ThinWalls, TooSoftForTheSpeedAreRefusedWithTheStiffnessNeeded) {
  Scene s = rings();
  place(s, Vec3::Zero());
  place(s, Vec3(20e-3, 0, 0)).velocity = {-5, 0, 0};
  s.pellet_contact.stiffness = 100;
  double needed = 0;
  try {
    run(s, 1e-3);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("contact.stiffness"), std::string::npos) << text;
    const std::size_t number = text.find("at least ");
    ASSERT_NE(number, std::string::npos) << text;
    needed = std::stod(text.substr(number + 9));
  }
  s.pellet_contact.stiffness = 1.001 * needed;
  run(s, 1e-4);  // accepted
  const double mass = kDensity * thin_ring()->volume, depth = 5 * std::sqrt(mass / needed);
  EXPECT_NEAR(depth, 0.3 * 0.5e-3, 1e-3 * depth)
      << "where the law of a spring reaches three tenths of the wall";
}

/// What the audit says of walls.
const AuditLine& walls(const Course& r) {
  for (const AuditLine& line : r.result.record.audit)
    if (line.name == "walls") return line;
  throw std::logic_error("nothing of walls in the audit");
}

TEST(ThinWalls, ThatAreNearlyPressedThroughEndTheRunWithWords) {
  // a ring on edge hits a fixed one many times as fast as the placing lets expect
  Scene s = rings();
  place(s, Vec3::Zero(), lying()).fixed = true;
  place(s, Vec3(9e-3, 0, 0));
  s.gravity = {-200, 0, 0};
  const Course r = run(s, 0.05);
  EXPECT_LT(r.result.record.time.simulated_s, 0.0499);
  EXPECT_FALSE(walls(r).passed);
  EXPECT_NE(walls(r).finding.find("contact.stiffness"), std::string::npos) << walls(r).finding;
}

TEST(ThinWalls, BodiesThatCouldSkipAWallEndTheRunWithWords) {
  Scene s = rings();
  place(s, Vec3::Zero(), lying()).fixed = true;
  place(s, Vec3(0.06, 0, 0));
  s.gravity = {-2000, 0, 0};
  const Course r = run(s, 0.05);
  EXPECT_LT(r.result.record.time.simulated_s, 0.0499);
  EXPECT_FALSE(walls(r).passed);
  EXPECT_NE(walls(r).finding.find("stepping.step"), std::string::npos) << walls(r).finding;
}

TEST(ThinWalls, StepsTooLongForTheSpeedAreRefused) {
  Scene s = rings();
  place(s, Vec3::Zero());
  place(s, Vec3(20e-3, 0, 0)).velocity = {-5, 0, 0};
  s.pellet_contact.stiffness = s.wall_contact.stiffness = 1e5;
  s.stepping.step = 10.5e-6;  // 52 um of a wall of 500 um
  try {
    run(s, 1e-3);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("stepping.step"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace packbed
