// The sides of a box, for both packers of bodies.
#include <gtest/gtest.h>

#include "laws/law.hpp"
#include "shapes.hpp"

namespace packbed {
namespace {

using namespace law;

class BoxSides : public testing::TestWithParam<std::tuple<std::string, int, int>> {};

// A body thrown at a side comes back as one thrown at the floor does, turned with it.
TEST_P(BoxSides, AreFloorsThatStandUpright) {
  const auto& [method, body, side] = GetParam();
  const ShapePtr shape = body == 0 ? make_sphere("ball", 2e-3) : a38();
  const auto thrown = [&](const Container& container, const Quat& turn, const Vec3& at) {
    Scene s = scene(ContainerKind::none, shape);
    s.method = method;
    s.container = container;
    set_contact(s, 0.3, 0.1);
    const Quat rotation(Eigen::AngleAxisd(0.4, Vec3(1, 2, 0.5).normalized()));
    PlacedPellet& p = place(s, at, turn * rotation);
    p.velocity = turn * Vec3(0.3, 0.2, -0.5);
    p.spin = turn * Vec3(20, -10, 5);
    return run(s, 4e-3).end();
  };
  const Vec3 outwards = (side % 2 == 0 ? 1 : -1) * (side < 2 ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY()));
  const Quat turn = Quat::FromTwoVectors(-Vec3(Vec3::UnitZ()), outwards);
  Container plane;
  plane.kind = ContainerKind::plane;
  const double height = shape->bounding_radius + 1e-4;
  const Pellet on_floor = thrown(plane, Quat::Identity(), {0, 0, height});
  const double half = side < 2 ? 10e-3 : 12e-3;
  const Vec3 middle(0, 0, 20e-3);
  const Pellet on_side =
      thrown(make_box("box", 20e-3, 24e-3, 60e-3), turn, middle + (half - height) * outwards);
  ASSERT_GT(on_floor.velocity.z(), 0.1);  // it has come back
  EXPECT_LT((on_side.velocity - turn * on_floor.velocity).norm(), 1e-9);
  EXPECT_LT((on_side.spin - turn * on_floor.spin).norm(), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Of, BoxSides,
                         testing::Combine(testing::Values("spheres"), testing::Values(0),
                                          testing::Range(0, 4)));
INSTANTIATE_TEST_SUITE_P(Meshes, BoxSides,
                         testing::Combine(testing::Values("mesh"), testing::Values(0, 1),
                                          testing::Range(0, 4)));

// A cup that is only a mesh: on its faces, and over the diagonals that these are cut along, as on exact
// sides.
TEST(Box, ThatIsOnlyAMeshTurnsSpheresBackAsExactSidesDo) {
  for (int i = 0; i < 6; ++i) {
    const auto thrown = [&](const Container& container) {
      Scene s = scene(ContainerKind::none, make_sphere("ball", 2e-3));
      s.method = "spheres";
      s.container = container;
      set_contact(s, 0.3, 0.1);
      PlacedPellet& p = place(s, i < 5 ? Vec3(2e-3, -2e-3, 2.1e-3) : Vec3(17.9e-3, 3e-3, 20e-3));
      p.velocity = i < 5 ? Vec3(0.1 * i, 0.1, -0.5) : Vec3(0.5, 0.1, 0.2);
      p.spin = {20, -10, 5};
      return run(s, 4e-3).end();
    };
    Container cup;
    cup.kind = ContainerKind::mesh;
    cup.radius = 20e-3;
    cup.height = 60e-3;
    cup.surface = test::square_cup(20e-3, 60e-3, 1e-3);
    const Pellet in_cup = thrown(cup), in_box = thrown(make_box("box", 40e-3, 40e-3, 60e-3));
    EXPECT_LT((in_cup.velocity - in_box.velocity).norm(), 1e-9) << i;
    EXPECT_LT((in_cup.spin - in_box.spin).norm(), 1e-5) << i;
    EXPECT_GT((in_box.velocity - Vec3(0.1 * i, 0.1, -0.5)).norm(), 0.1);  // it has hit
  }
}

TEST(Box, HoldsAPour) {
  for (const char* method : {"spheres", "mesh"}) {
    Scene s = scene(ContainerKind::none, make_sphere("ball", 2e-3));
    s.method = method;
    s.container = make_box("box", 24e-3, 20e-3, 80e-3);
    set_contact(s, 0.4, 0.4);
    s.pellet_contact.stiffness = s.wall_contact.stiffness = 2e3;
    s.gravity = {0, 0, -kGravity};
    s.feed.kind = FeedKind::pour;
    s.feed.count = 80;
    s.feed.per_layer = 8;
    s.feed.interval = 0.02;
    s.feed.drop_height = 50e-3;
    s.stepping.max_time = 3;
    const PackResult r = pack(s, {});
    EXPECT_EQ(r.record.pellets.inside, 80) << method;
    EXPECT_TRUE(r.record.audit_passed()) << method;
  }
}

}  // namespace
}  // namespace packbed
