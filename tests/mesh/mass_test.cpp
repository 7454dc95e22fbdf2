// Mass properties of polyhedra against their closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "math/random.hpp"
#include "mesh/build.hpp"
#include "mesh/mesh.hpp"

namespace packbed {
namespace {

TEST(MassProperties, BoxHasItsClosedForm) {
  const Vec3 size(2e-3, 3e-3, 5e-3);
  const MassProperties m = mass_properties(box_mesh(Vec3::Zero(), size));
  const double v = size.prod();
  EXPECT_NEAR(m.volume / v, 1, 1e-15);
  EXPECT_NEAR(m.area / (2 * (6e-6 + 10e-6 + 15e-6)), 1, 1e-15);
  EXPECT_LT((m.centre - size / 2).norm(), 1e-18);
  EXPECT_NEAR(m.inertia(0, 0) / (v / 12 * (9e-6 + 25e-6)), 1, 1e-14);
  EXPECT_NEAR(m.inertia(2, 2) / (v / 12 * (4e-6 + 9e-6)), 1, 1e-14);
  EXPECT_LT(std::abs(m.inertia(0, 1)), 1e-15 * m.inertia(0, 0));
}

// A regular n-gon prism: area (n/2) R^2 sin(2 pi/n); polar moment (n/12) R^4 sin(2 pi/n) (2 + cos(2 pi/n)).
TEST(MassProperties, PrismHasItsClosedForm) {
  const int n = 13;
  const double R = 1.71e-3, H = 3.46e-3, a = 2 * kPi / n;
  const MassProperties m = mass_properties(revolved({{0, 0}, {R, 0}, {R, H}, {0, H}}, n));
  const double section = n / 2.0 * R * R * std::sin(a);
  const double polar = n / 12.0 * std::pow(R, 4) * std::sin(a) * (2 + std::cos(a));
  EXPECT_NEAR(m.volume / (section * H), 1, 1e-13);
  EXPECT_NEAR(m.inertia(2, 2) / (polar * H), 1, 1e-13);
  EXPECT_NEAR(m.inertia(0, 0) / (polar * H / 2 + section * H * H * H / 12), 1, 1e-13);
}

TEST(MassProperties, PlaceOfTheOriginCostsNoDigits) {
  const TriangleMesh mesh = revolved({{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 16);
  const MassProperties near = mass_properties(mesh);
  const MassProperties far = mass_properties(transformed(mesh, 1, Quat::Identity(), Vec3(4096, -8192, 1024)));
  EXPECT_NEAR(far.volume / near.volume, 1, 1e-11);
  EXPECT_LT((far.inertia - near.inertia).norm() / near.inertia.norm(), 1e-11);
}

TEST(MassProperties, RotationTurnsTheInertiaTensor) {
  const TriangleMesh mesh = box_mesh(Vec3(-1, -2, -3), Vec3(2, 1, 4));
  Random random(1, Stream::test, 0);
  const Quat q = random.rotation();
  const MassProperties a = mass_properties(mesh), b = mass_properties(transformed(mesh, 2, q, Vec3(5, 6, 7)));
  EXPECT_NEAR(b.volume / a.volume, 8, 1e-12);
  EXPECT_LT((b.inertia / 32 - q * a.inertia * q.conjugate()).norm() / a.inertia.norm(), 1e-13);
  EXPECT_LT((b.centre - (q * (2 * a.centre) + Vec3(5, 6, 7))).norm(), 1e-12);
}

TEST(MassProperties, InsideOutHasNegativeVolumeAndTheSameCentre) {
  TriangleMesh mesh = box_mesh(Vec3(1, 1, 1), Vec3(2, 3, 4));
  const MassProperties a = mass_properties(mesh);
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  const MassProperties b = mass_properties(mesh);
  EXPECT_DOUBLE_EQ(b.volume, -a.volume);
  EXPECT_LT((b.centre - a.centre).norm(), 1e-15);
  EXPECT_LT((b.inertia - a.inertia).norm(), 1e-13);
}

// A cube cut into six tetrahedra round its diagonal (Kuhn): the same body as its surface.
TEST(MassProperties, TetrahedraAgreeWithTheirBoundary) {
  TetMesh tets;
  tets.vertices = box_mesh(Vec3(-1, 0, 2), Vec3(1, 3, 3)).vertices;
  tets.tets = {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}};
  const MassProperties whole = mass_properties(tets), skin = mass_properties(boundary(tets));
  EXPECT_EQ(boundary(tets).triangles.size(), 12u);
  EXPECT_NEAR(whole.volume, 6, 1e-14);
  EXPECT_NEAR(skin.volume, 6, 1e-14);
  EXPECT_NEAR(whole.area, 2 * (6 + 2 + 3), 1e-14);
  EXPECT_LT((whole.inertia - skin.inertia).norm(), 1e-13);
}

}  // namespace
}  // namespace packbed
