// Containers from meshes: cups are recognised, everything else is put on the axes of the bed.
#include "shape/container.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/build.hpp"

namespace packbed {
namespace {

constexpr double kR = 22.25e-3, kOut = 25.25e-3, kH = 140e-3, kFloor = 3e-3;  // LC

TriangleMesh lc(int facets = 72) {
  return revolved({{0, 0}, {kOut, 0}, {kOut, kFloor + kH}, {kR, kFloor + kH}, {kR, kFloor}, {0, kFloor}},
                  facets);
}

TriangleMesh shifted(const TriangleMesh& mesh, const Vec3& by) {
  return transformed(mesh, 1, Quat::Identity(), by);
}

TEST(MakeContainer, RecognisesACupWithTheSizeOfItsCorners) {
  for (const int facets : {12, 72}) {
    const Container c = make_container("lc", "file", shifted(lc(facets), Vec3(0.3, -0.2, 0.1)));
    ASSERT_EQ(c.kind, ContainerKind::tube);
    EXPECT_NEAR(c.radius, kR, 1e-9);
    EXPECT_NEAR(c.height, kH, 1e-9);
    EXPECT_NEAR(bounding_box(c.surface).min().z(), -kFloor, 1e-12);
    EXPECT_LT(bounding_box(c.surface).center().head<2>().norm(), 1e-9);
    EXPECT_NEAR(c.mesh_volume / mass_properties(lc(facets)).volume, 1, 1e-9);
  }
}

TEST(MakeContainer, OutsideOfACupMayHaveAnyForm) {
  const TriangleMesh flanged = revolved({{0, 0},
                                         {40e-3, 0},
                                         {40e-3, 2e-3},
                                         {kOut, kFloor},
                                         {kOut, 0.1},
                                         {30e-3, 0.1},
                                         {30e-3, kFloor + kH},
                                         {kR, kFloor + kH},
                                         {kR, kFloor},
                                         {0, kFloor}},
                                        48);
  EXPECT_EQ(make_container("c", "file", flanged).kind, ContainerKind::tube);
}

TEST(MakeContainer, NotRecognisingLeavesAMeshOnTheSameAxes) {
  const Container c = make_container("lc", "file", shifted(lc(), Vec3(0.3, -0.2, 0.1)), false);
  ASSERT_EQ(c.kind, ContainerKind::mesh);
  EXPECT_NEAR(c.height, kH, 1e-9);
  EXPECT_NEAR(c.radius, kR * std::cos(kPi / 72), 1e-9);  // the largest circle inside the polygon
}

TEST(MakeContainer, TaperedVesselIsAMeshWithItsFloorAtZero) {
  const TriangleMesh taper =
      revolved({{0, 0}, {23e-3, 0}, {25.25e-3, 0.123}, {22.25e-3, 0.123}, {20e-3, 3e-3}, {0, 3e-3}}, 64);
  const Container c = make_container("taper", "file", shifted(taper, Vec3(1, 2, 3)));
  ASSERT_EQ(c.kind, ContainerKind::mesh);
  EXPECT_NEAR(c.height, 0.12, 1e-9);
  EXPECT_NEAR(c.radius, 21.125e-3 * std::cos(kPi / 64), 1e-9);
  EXPECT_NEAR(bounding_box(c.surface).min().z(), -3e-3, 1e-9);
}

TEST(MakeContainer, BaffleInsideIsNoTube) {
  const Container c = make_container("c", "file",
                                     revolved({{0, 0},
                                               {kOut, 0},
                                               {kOut, kH},
                                               {kR, kH},
                                               {kR, 0.08},
                                               {0.01, 0.07},
                                               {kR, 0.06},
                                               {kR, kFloor},
                                               {0, kFloor}},
                                              48));
  EXPECT_EQ(c.kind, ContainerKind::mesh);
}

TEST(MakeContainer, AnnulusStandsOnTheFloorOfItsHollow) {
  for (const double core_top : {kFloor + kH, kFloor + 1.1 * kH, kFloor + 0.8 * kH}) {
    const TriangleMesh annulus = revolved({{0, 0},
                                           {kOut, 0},
                                           {kOut, kFloor + kH},
                                           {kR, kFloor + kH},
                                           {kR, kFloor},
                                           {7.5e-3, kFloor},
                                           {7.5e-3, core_top},
                                           {0, core_top}},
                                          64);
    const Container c = make_container("annulus", "file", shifted(annulus, Vec3(1, 2, 3)));
    ASSERT_EQ(c.kind, ContainerKind::mesh);
    EXPECT_NEAR(bounding_box(c.surface).min().z(), -kFloor, 1e-12);
    EXPECT_NEAR(c.height, std::max(core_top - kFloor, kH), 1e-12);
    EXPECT_NEAR(c.radius, kR * std::cos(kPi / 64), 1e-9);
    EXPECT_NEAR(c.core_radius, 7.5e-3, 1e-9);
  }
}

TEST(MakeContainer, SolidBlockHasNoInside) {
  const Container c = make_container("c", "file", box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  EXPECT_EQ(c.kind, ContainerKind::mesh);
  EXPECT_DOUBLE_EQ(c.height, 0);
}

// A square cup whose corners lie on the axes: its sides do not stand along x and y.
TriangleMesh diamond() {
  return revolved({{0, 0}, {0.03, 0}, {0.03, 0.1}, {0.02, 0.1}, {0.02, 0.004}, {0, 0.004}}, 4);
}

TEST(MakeContainer, SlantedBoxKeepsItsFreeCircle) {
  const Container c = make_container("box", "file", diamond());
  EXPECT_EQ(c.kind, ContainerKind::mesh);
  EXPECT_NEAR(c.radius, 0.02 * std::cos(kPi / 4), 1e-12);
  EXPECT_NEAR(c.height, 0.096, 1e-12);
}

TEST(MakeContainer, RecognisesABoxThatStandsAlongTheAxes) {
  const Quat turn(Eigen::AngleAxisd(kPi / 4, Vec3::UnitZ()));
  TriangleMesh box = transformed(diamond(), 1, turn, Vec3(0.5, 0.2, -0.3));
  for (Vec3& v : box.vertices) v.y() = 0.2 + 1.5 * (v.y() - 0.2);
  const Container c = make_container("box", "file", box);
  ASSERT_EQ(c.kind, ContainerKind::box);
  EXPECT_NEAR(c.width, 0.02 * std::sqrt(2), 1e-9);
  EXPECT_NEAR(c.depth, 0.03 * std::sqrt(2), 1e-9);
  EXPECT_NEAR(c.radius, c.width / 2, 1e-12);
  EXPECT_NEAR(c.height, 0.096, 1e-12);
  EXPECT_NEAR(bounding_box(c.surface).min().z(), -0.004, 1e-12);
  EXPECT_LT(bounding_box(c.surface).center().head<2>().norm(), 1e-9);
  EXPECT_EQ(make_container("box", "file", box, false).kind, ContainerKind::mesh);
}

TEST(MakeBox, IsGivenByItsSizes) {
  const Container c = make_box("box", 0.2, 0.3, 2);
  EXPECT_EQ(c.kind, ContainerKind::box);
  EXPECT_DOUBLE_EQ(c.radius, 0.1);
  EXPECT_DOUBLE_EQ(c.height, 2);
  EXPECT_TRUE(c.surface.triangles.empty());
}

TEST(MakeTube, IsGivenByItsSizes) {
  const Container c = make_tube("lc", 2 * kR, kH);
  EXPECT_EQ(c.kind, ContainerKind::tube);
  EXPECT_DOUBLE_EQ(c.radius, kR);
  EXPECT_TRUE(c.surface.triangles.empty());
}

}  // namespace
}  // namespace packbed
