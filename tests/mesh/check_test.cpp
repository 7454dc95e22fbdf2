// One test a reason for which a mesh is refused or repaired.
#include "mesh/check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/build.hpp"
#include "mesh/repair.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

TriangleMesh cube() {
  return box_mesh(Vec3(0, 0, 0), Vec3(1e-3, 1e-3, 1e-3));
}

// Every triangle with vertices of its own, as in an STL file.
TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (const auto& t : mesh.triangles) {
    const auto n = static_cast<std::int32_t>(out.vertices.size());
    for (int k = 0; k < 3; ++k) out.vertices.push_back(corner(mesh, t, k));
    out.triangles.push_back({n, n + 1, n + 2});
  }
  return out;
}

MeshProblem fatal_of(const TriangleMesh& mesh, const MeshCheckOptions& options = {}) {
  const MeshReport report = check_mesh(mesh, options);
  EXPECT_NE(report.fatal(), nullptr);
  if (report.fatal() == nullptr) return MeshProblem::thin_wall;
  EXPECT_FALSE(report.fatal()->sentence.empty());
  return report.fatal()->problem;
}

TEST(CheckMesh, GoodMeshHasNothingFatal) {
  const MeshReport report = check_mesh(cube());
  EXPECT_TRUE(report.findings.empty());
  EXPECT_EQ(report.solids, 1);
  EXPECT_EQ(report.cavities, 0);
}

TEST(CheckMesh, SoupIsWelded) {
  const MeshReport report = check_mesh(soup(cube()));
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_EQ(report.welded, 28u);
  EXPECT_EQ(report.mesh.vertices.size(), 8u);
}

TEST(CheckMesh, MinusZeroIsZero) {
  TriangleMesh mesh = soup(cube());
  mesh.vertices[0] = Vec3(-0.0, 0.0, -0.0);
  EXPECT_EQ(check_mesh(mesh).fatal(), nullptr);
}

TEST(CheckMesh, FewDigitsAreJoinedAndTold) {
  TriangleMesh mesh = soup(cube());
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 2) mesh.vertices[i] += Vec3::Constant(3e-11);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_TRUE(report.has(MeshProblem::open));
  EXPECT_EQ(report.mesh.vertices.size(), 8u);
}

TEST(CheckMesh, EmptyIsRefused) {
  EXPECT_EQ(fatal_of({}), MeshProblem::empty);
}

TEST(CheckMesh, IndexOutOfRangeIsRefused) {
  TriangleMesh mesh = cube();
  mesh.triangles[3][1] = 8;
  mesh.triangles[4][1] = -1;
  EXPECT_EQ(fatal_of(mesh), MeshProblem::bad_index);
  EXPECT_EQ(check_mesh(mesh).fatal()->count, 2u);
}

TEST(CheckMesh, NotFiniteIsRefused) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = cube();
    mesh.vertices[5].y() = bad;
    EXPECT_EQ(fatal_of(mesh), MeshProblem::not_finite);
    EXPECT_NE(check_mesh(mesh).fatal()->sentence.find("vertex 6"), std::string::npos);
  }
}

TEST(CheckMesh, OpenIsRefusedWithCountAndPlace) {
  TriangleMesh mesh = cube();
  mesh.triangles.pop_back();
  EXPECT_EQ(fatal_of(mesh), MeshProblem::open);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.fatal()->count, 3u);
  EXPECT_DOUBLE_EQ(report.fatal()->place.x(), 1e-3);
}

TEST(CheckMesh, EdgeOfFourTrianglesIsRefused) {
  const MeshReport report = check_mesh(merged(cube(), box_mesh(Vec3(1e-3, 1e-3, 0), Vec3(2e-3, 2e-3, 1e-3))));
  ASSERT_NE(report.fatal(), nullptr);
  EXPECT_EQ(report.fatal()->problem, MeshProblem::not_manifold);
  EXPECT_EQ(report.fatal()->count, 1u);
}

TEST(CheckMesh, PinchedVertexIsRefused) {
  const MeshReport report =
      check_mesh(merged(cube(), box_mesh(Vec3(1e-3, 1e-3, 1e-3), Vec3(2e-3, 2e-3, 2e-3))));
  ASSERT_NE(report.fatal(), nullptr);
  EXPECT_EQ(report.fatal()->problem, MeshProblem::not_manifold);
  EXPECT_LT((report.fatal()->place - Vec3::Constant(1e-3)).norm(), 1e-15);
}

TEST(CheckMesh, InconsistentIsTurnedAndTold) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_TRUE(report.has(MeshProblem::inconsistent));
  EXPECT_EQ(report.findings[0].count, 2u);
  EXPECT_NEAR(mass_properties(report.mesh).volume, 1e-9, 1e-22);
  EXPECT_EQ(fatal_of(mesh, {.repair = false}), MeshProblem::inconsistent);
}

// The first triangle is the wrong one: turning the others to it makes the whole inside out, which is then
// turned.
TEST(CheckMesh, InconsistentFirstTriangleStillGivesTheBody) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_EQ(report.findings[0].count, 1u);
  EXPECT_NEAR(mass_properties(report.mesh).volume, 1e-9, 1e-22);
}

TEST(CheckMesh, InvertedIsTurnedAndTold) {
  TriangleMesh mesh = cube();
  turn_over(mesh);
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_TRUE(report.has(MeshProblem::inverted));
  EXPECT_GT(mass_properties(report.mesh).volume, 0);
  EXPECT_EQ(fatal_of(mesh, {.repair = false}), MeshProblem::inverted);
}

TEST(CheckMesh, CavityIsMaterialLeftOut) {
  TriangleMesh hole = box_mesh(Vec3::Constant(2e-4), Vec3::Constant(5e-4));
  turn_over(hole);
  const MeshReport report = check_mesh(merged(cube(), hole));
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_EQ(report.solids, 1);
  EXPECT_EQ(report.cavities, 1);
  EXPECT_NEAR(mass_properties(report.mesh).volume, 1e-9 - 2.7e-11, 1e-20);
  EXPECT_NEAR(report.thinnest_wall, 2e-4, 1e-12);
}

TEST(CheckMesh, BodyInsideABodyIsRefused) {
  EXPECT_EQ(fatal_of(merged(cube(), box_mesh(Vec3::Constant(2e-4), Vec3::Constant(5e-4)))),
            MeshProblem::inverted);
}

TEST(CheckMesh, SeveralSolidsAreRefusedUnlessAllowed) {
  const TriangleMesh two = merged(cube(), box_mesh(Vec3::Constant(2e-3), Vec3::Constant(3e-3)));
  EXPECT_EQ(fatal_of(two), MeshProblem::several_solids);
  const MeshReport report = check_mesh(two, {.several_solids = true});
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_EQ(report.solids, 2);
}

TEST(CheckMesh, SelfCrossingIsRefused) {
  const TriangleMesh two = merged(cube(), box_mesh(Vec3::Constant(5e-4), Vec3::Constant(1.7e-3)));
  EXPECT_EQ(fatal_of(two, {.several_solids = true}), MeshProblem::self_crossing);
  // one piece: a corner of the cube pulled through the opposite face
  TriangleMesh one = cube();
  one.vertices[7] = Vec3(-1e-3, 0.4e-3, 0.4e-3);
  EXPECT_EQ(fatal_of(one), MeshProblem::self_crossing);
}

TEST(CheckMesh, TrianglesThatNameAVertexTwiceAreDropped) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({1, 1, 5});
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_TRUE(report.has(MeshProblem::degenerate));
  EXPECT_EQ(report.mesh.triangles.size(), 12u);
}

// An edge of the cube gets a vertex in its middle on one side only, closed by a triangle without area.
TEST(CheckMesh, NeedleIsSwappedAway) {
  TriangleMesh mesh = cube();
  const auto m = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (mesh.vertices[0] + mesh.vertices[3]));
  mesh.triangles[0] = {0, 2, m};
  mesh.triangles.push_back({m, 2, 3});
  mesh.triangles.push_back({0, m, 3});
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_TRUE(report.has(MeshProblem::degenerate));
  EXPECT_TRUE(degenerate_triangles(report.mesh).empty());
  EXPECT_NEAR(mass_properties(report.mesh).volume, 1e-9, 1e-22);
}

TEST(CheckMesh, AllDegenerateIsRefused) {
  TriangleMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {0, 2, 3}, {0, 1, 3}};
  EXPECT_EQ(fatal_of(mesh), MeshProblem::degenerate);
}

TEST(CheckMesh, FlatSolidIsRefused) {
  TriangleMesh mesh = box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1e-11));
  EXPECT_EQ(fatal_of(mesh), MeshProblem::no_volume);
}

TEST(CheckMesh, ThinWallIsTold) {
  const MeshReport report = check_mesh(box_mesh(Vec3(0, 0, 0), Vec3(1e-2, 1e-2, 1e-4)));
  EXPECT_EQ(report.fatal(), nullptr);
  EXPECT_TRUE(report.has(MeshProblem::thin_wall));
  EXPECT_NEAR(report.thinnest_wall, 1e-4, 1e-15);
}

TEST(ThinnestWall, OfACupIsItsWall) {
  const TriangleMesh cup =
      revolved({{0, -4e-3}, {25e-3, -4e-3}, {25e-3, 50e-3}, {22e-3, 50e-3}, {22e-3, 0}, {0, 0}}, 64);
  // measured square to the facets: the difference of the two inradii
  EXPECT_NEAR(thinnest_wall(cup).value, 3e-3 * std::cos(kPi / 64), 1e-9);
}

TEST(ThinnestWall, OfATetrahedronIsItsSmallestWidth) {
  TriangleMesh mesh;
  mesh.vertices = {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  ASSERT_GT(mass_properties(mesh).volume, 0);
  EXPECT_NEAR(thinnest_wall(mesh).value, 2, 1e-12);  // edge 2 sqrt(2): between opposite edges, edge / sqrt(2)
}

}  // namespace
}  // namespace packbed
