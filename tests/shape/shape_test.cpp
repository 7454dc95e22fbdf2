// Shapes from meshes: what is recognised, what is not, and that nothing is lost on the way.
#include "shape/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/error.hpp"
#include "math/random.hpp"
#include "mesh/build.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

constexpr double kR = 1.71e-3, kH = 3.46e-3;  // A38

TriangleMesh a38(int facets, double radius = kR, double height = kH) {
  return revolved({{0, 0}, {radius, 0}, {radius, height}, {0, height}}, facets);
}

Pose somewhere(std::uint32_t event) {
  Random random(3, Stream::test, 0, event);
  return {Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)), random.rotation()};
}

TriangleMesh moved(const TriangleMesh& mesh, const Pose& pose) {
  return transformed(mesh, 1, pose.rotation, pose.position);
}

// The shape's mass properties, moved back to the file's frame, must be those of the file's mesh scaled to its
// volume.
void expect_own_frame_is_principal(const Shape& s) {
  const MassProperties own = mass_properties(s.surface);
  const double scale = own.inertia.diagonal().maxCoeff();
  EXPECT_LT(own.centre.norm(), 2e-3 * s.bounding_radius);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(own.inertia(i, i), s.inertia[i], 0.02 * scale);
    EXPECT_LT(std::abs(own.inertia(i, (i + 1) % 3)), 2e-3 * scale);
  }
  EXPECT_NEAR(own.volume / s.volume, 1, 1e-12);
}

TEST(MakeCylinder, HasItsClosedForm) {
  const ShapePtr s = make_cylinder("a38", 2 * kR, kH);
  EXPECT_EQ(s->kind, ShapeClass::cylinder);
  EXPECT_NEAR(s->volume / (kPi * kR * kR * kH), 1, 1e-15);
  EXPECT_NEAR(s->area / (2 * kPi * kR * (kR + kH)), 1, 1e-15);
  EXPECT_NEAR(s->inertia.z() / (s->volume * kR * kR / 2), 1, 1e-15);
  EXPECT_NEAR(s->inertia.x() / (s->volume * (3 * kR * kR + kH * kH) / 12), 1, 1e-15);
  EXPECT_NEAR(s->equivalent_diameter(), 3.93e-3, 5e-6);
  EXPECT_DOUBLE_EQ(s->smallest_thickness, 2 * kR);
  expect_own_frame_is_principal(*s);
}

TEST(MakeSphere, HasItsClosedForm) {
  const ShapePtr s = make_sphere("ball", 2e-3);
  EXPECT_EQ(s->kind, ShapeClass::sphere);
  EXPECT_NEAR(s->equivalent_diameter(), 4e-3, 1e-17);
  EXPECT_NEAR(s->inertia.x() / (0.4 * s->volume * 4e-6), 1, 1e-15);
  expect_own_frame_is_principal(*s);
}

TEST(MakeShape, RecognisesACylinderInAnyPoseWithTheSizeOfItsCorners) {
  for (std::uint32_t i = 0; i < 8; ++i)
    for (const int facets : {9, 12, 48, 200}) {
      const TriangleMesh file = moved(a38(facets), somewhere(i));
      const ShapePtr s = make_shape("p", "file", file);
      ASSERT_EQ(s->kind, ShapeClass::cylinder) << facets;
      EXPECT_NEAR(s->radius, kR, 1e-9 * kR);
      EXPECT_NEAR(s->half_height, kH / 2, 1e-9 * kH);
      EXPECT_NEAR(s->mesh_volume / mass_properties(file).volume, 1, 1e-12);
      EXPECT_NEAR(s->mesh_volume / s->volume, facets / (2 * kPi) * std::sin(2 * kPi / facets), 1e-9);
      expect_own_frame_is_principal(*s);
      // the ends stay where they are, whatever is done to the round side
      for (const Vec3& p : s->surface.vertices) EXPECT_NEAR(std::abs(p.z()), kH / 2, 1e-12);
    }
}

TEST(MakeShape, RecognisesTheCylinderThatHasNoPrincipalAxisOfItsOwn) {
  const double height = std::sqrt(3.0) * kR;
  const ShapePtr s = make_shape("p", "file", moved(a38(48, kR, height), somewhere(1)));
  ASSERT_EQ(s->kind, ShapeClass::cylinder);
  EXPECT_NEAR(s->half_height, height / 2, 1e-9 * height);
}

TEST(MakeShape, RecognisesDiscsAndRods) {
  for (const double height : {0.02 * kR, 60 * kR}) {
    const ShapePtr s = make_shape("p", "file", moved(a38(48, kR, height), somewhere(2)));
    ASSERT_EQ(s->kind, ShapeClass::cylinder) << height;
    EXPECT_NEAR(2 * s->half_height / height, 1, 1e-9);
    EXPECT_NEAR(s->radius / kR, 1, 1e-9);
  }
}

TEST(MakeShape, RecognisesASphereInAnyPose) {
  std::vector<std::pair<double, double>> profile{{0, -kR}};
  for (int i = 1; i < 16; ++i)
    profile.emplace_back(kR * std::sin(kPi * i / 16), -kR * std::cos(kPi * i / 16));
  profile.emplace_back(0, kR);
  const ShapePtr s = make_shape("p", "file", moved(revolved(profile, 32), somewhere(4)));
  ASSERT_EQ(s->kind, ShapeClass::sphere);
  EXPECT_NEAR(s->radius / kR, 1, 1e-9);
  EXPECT_LT(s->mesh_volume, s->volume);
  expect_own_frame_is_principal(*s);
}

TEST(MakeShape, PolygonsOfEightSidesAndCubesAreConvexPolyhedra) {
  const auto faces = [](const TriangleMesh& mesh) {
    const ShapePtr s = make_shape("p", "file", mesh);
    EXPECT_EQ(s->kind, ShapeClass::convex);
    return std::pair(s->planes.size(), s->corners.size());
  };
  EXPECT_EQ(faces(moved(a38(8), somewhere(3))), std::pair(std::size_t{10}, std::size_t{16}));
  EXPECT_EQ(faces(moved(box_mesh(Vec3::Zero(), Vec3(1, 2, 3)), somewhere(4))),
            std::pair(std::size_t{6}, std::size_t{8}));
}

TEST(MakeShape, BarrelConeAndDomedEndsAreNoCylinders) {
  const auto kind = [](const std::vector<std::pair<double, double>>& profile, int facets) {
    return make_shape("p", "file", revolved(profile, facets))->kind;
  };
  for (const auto& [facets, is] : {std::pair{48, ShapeClass::convex}, {200, ShapeClass::mesh}}) {
    EXPECT_EQ(kind({{0, 0}, {1, 0}, {1.02, 1}, {1, 2}, {0, 2}}, facets), is);
    EXPECT_EQ(kind({{0, 0}, {1, 0}, {0.98, 2}, {0, 2}}, facets), is);
    EXPECT_EQ(kind({{0, 0}, {1, 0}, {1, 2}, {0, 2.05}}, facets), is);
  }
}

TEST(MakeShape, PlanesAndCornersBoundTheBody) {
  const ShapePtr s = make_shape("p", "file", moved(a38(8), somewhere(6)));
  for (const Vec3& p : s->corners) {
    int on = 0;
    for (const Plane& plane : s->planes) {
      EXPECT_NEAR(plane.normal.norm(), 1, 1e-12);
      EXPECT_LT(plane.normal.dot(p) - plane.offset, 1e-9 * kR);
      on += std::abs(plane.normal.dot(p) - plane.offset) < 1e-9 * kR;
    }
    EXPECT_EQ(on, 3);
  }
}

TriangleMesh ring(double outer, double inner, double height, int facets) {
  return revolved({{inner, 0}, {outer, 0}, {outer, height}, {inner, height}}, facets);
}

TEST(MakeShape, RecognisesATubeInAnyPoseWithTheSizesOfItsCorners) {
  for (std::uint32_t i = 0; i < 4; ++i)
    for (const double inner : {0.1 * kR, 0.5 * kR, 0.95 * kR}) {
      const ShapePtr s = make_shape("p", "file", moved(ring(kR, inner, kH, 48), somewhere(i)));
      ASSERT_EQ(s->kind, ShapeClass::tube) << inner;
      EXPECT_NEAR(s->radius, kR, 1e-9 * kR);
      EXPECT_NEAR(s->inner_radius, inner, 1e-9 * kR);
      EXPECT_NEAR(s->half_height, kH / 2, 1e-9 * kH);
      EXPECT_NEAR(s->volume / (kPi * (kR * kR - inner * inner) * kH), 1, 1e-8);
      EXPECT_NEAR(s->smallest_thickness, kR - inner, 1e-9 * kR);
      EXPECT_EQ(s->thin_walled(), inner > 0.8 * kR);
      expect_own_frame_is_principal(*s);
    }
}

TEST(MakeShape, NotEveryHoleMakesATube) {
  const auto kind = [](const TriangleMesh& mesh) { return make_shape("p", "file", mesh)->kind; };
  EXPECT_EQ(kind(revolved({{0.5, 0}, {1, 0}, {1, 2}, {0.6, 2}}, 48)), ShapeClass::mesh);  // a funnel
  EXPECT_EQ(kind(revolved({{0.5, 0}, {1, 0}, {1, 2}, {0, 2}, {0, 1}, {0.5, 1}}, 48)),
            ShapeClass::mesh);                            // blind
  EXPECT_EQ(kind(ring(1, 0.5, 2, 8)), ShapeClass::mesh);  // an octagon
  TriangleMesh off = ring(1, 0.5, 2, 48);
  for (Vec3& p : off.vertices)
    if (p.head<2>().norm() < 0.6) p.x() += 0.01;  // not about the axis
  EXPECT_EQ(kind(off), ShapeClass::mesh);
}

TEST(MakeRing, HasItsClosedForm) {
  const double inner = 0.6 * kR;
  const ShapePtr s = make_ring("ring", 2 * kR, 2 * inner, kH);
  Shape rest = *make_cylinder("outside", 2 * kR, kH);
  const Shape hole = *make_cylinder("hole", 2 * inner, kH);
  EXPECT_EQ(s->kind, ShapeClass::tube);
  EXPECT_NEAR(s->volume / (rest.volume - hole.volume), 1, 1e-14);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(s->inertia[k] / (rest.inertia[k] - hole.inertia[k]), 1, 1e-13);
  const double ends = 2 * kPi * inner * inner;
  EXPECT_NEAR(s->area / (rest.area + hole.area - 2 * ends), 1, 1e-14);
  expect_own_frame_is_principal(*s);
  EXPECT_THROW(make_ring("ring", 2 * kR, 2 * kR, kH), InputError);
}

TEST(MakeShape, ToleranceIsTheStatedOne) {
  TriangleMesh inside = a38(48), outside = a38(48);
  inside.vertices[5].head<2>() *= 1 + 0.8 * kRecogniseTolerance;
  outside.vertices[5].head<2>() *= 1 + 1.5 * kRecogniseTolerance;
  EXPECT_EQ(make_shape("p", "file", inside)->kind, ShapeClass::cylinder);
  EXPECT_EQ(make_shape("p", "file", outside)->kind, ShapeClass::mesh);
}

TEST(MakeShape, TrueVolumeTellsAPrismFromACylinder) {
  const TriangleMesh mesh = a38(12);
  const double prism = mass_properties(mesh).volume;
  EXPECT_EQ(make_shape("p", "file", mesh, true, kPi * kR * kR * kH)->kind, ShapeClass::cylinder);
  EXPECT_EQ(make_shape("p", "file", mesh, true, prism)->kind, ShapeClass::convex);
}

TEST(MakeShape, NotRecognisingLeavesTheMeshTheBody) {
  const TriangleMesh mesh = moved(a38(48), somewhere(5));
  const ShapePtr s = make_shape("p", "file", mesh, false);
  EXPECT_EQ(s->kind, ShapeClass::mesh);
  EXPECT_NEAR(s->volume / mass_properties(mesh).volume, 1, 1e-12);
  EXPECT_DOUBLE_EQ(s->radius, 0);
  // the axis of revolution is z
  EXPECT_NEAR(s->inertia.x() / s->inertia.y(), 1, 1e-9);
  EXPECT_NEAR(s->smallest_thickness, 2 * kR, 5e-3 * kR);
  expect_own_frame_is_principal(*s);
}

TEST(MakeShape, VolumeIsConservedWhenTheCadVolumeIsKnown) {
  const TriangleMesh funnel =
      moved(revolved({{1e-3, 0}, {2e-3, 0}, {2e-3, 5e-3}, {1.5e-3, 5e-3}}, 24), somewhere(6));
  const double exact = kPi * 5e-3 * (4e-6 - (1 + 1.5 + 2.25) * 1e-6 / 3);
  const ShapePtr s = make_shape("funnel", "file", funnel, true, exact);
  EXPECT_EQ(s->kind, ShapeClass::mesh);
  EXPECT_NEAR(s->volume / exact, 1, 1e-12);
  EXPECT_LT(s->mesh_volume, 0.99 * exact);
  expect_own_frame_is_principal(*s);
}

TEST(MakeShape, FrameFollowsTheFileWhereItCan) {
  const ShapePtr s = make_shape("brick", "file", box_mesh(Vec3(0, 0, 0), Vec3(3, 2, 1)));
  EXPECT_LT((s->from_file.rotation.toRotationMatrix() - Mat3::Identity()).norm(), 1e-9);
  EXPECT_LT((s->from_file.position - Vec3(1.5, 1, 0.5)).norm(), 1e-14);
}

TEST(MakeShape, FileFrameComesBack) {
  const TriangleMesh file = moved(box_mesh(Vec3(0, 0, 0), Vec3(3e-3, 2e-3, 1e-3)), somewhere(7));
  const ShapePtr s = make_shape("brick", "file", file);
  for (std::size_t i = 0; i < file.vertices.size(); ++i)
    EXPECT_LT((s->from_file.to_world(Vec3::Zero()) +
               s->from_file.rotation.conjugate() * s->surface.vertices[i] - file.vertices[i])
                  .norm(),
              1e-15);
  EXPECT_NEAR(s->from_file.rotation.norm(), 1, 1e-15);
  expect_own_frame_is_principal(*s);
}

TEST(MakeShape, MeshInsideOutIsRefused) {
  TriangleMesh mesh = a38(16);
  turn_over(mesh);
  EXPECT_THROW(make_shape("p", "file", mesh), InputError);
}

TEST(WithTets, FillTheShapeInItsOwnFrame) {
  TetMesh tets;
  const Pose pose = somewhere(8);
  tets.vertices = moved(box_mesh(Vec3(0, 0, 0), Vec3(3e-3, 2e-3, 1e-3)), pose).vertices;
  tets.tets = {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}};
  const ShapePtr bare = make_shape("brick", "file", boundary(tets));
  const ShapePtr s = with_tets(*bare, tets);
  ASSERT_TRUE(s->tets.has_value());
  const MassProperties m = mass_properties(*s->tets);
  EXPECT_NEAR(m.volume / s->volume, 1, 1e-12);
  EXPECT_LT(m.centre.norm(), 1e-15);
  EXPECT_LT((m.inertia.diagonal() - s->inertia).norm(), 1e-9 * s->inertia.norm());
}

}  // namespace
}  // namespace packbed
