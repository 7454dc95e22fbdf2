// The oracle itself, against bodies whose answers are known in closed form.
#include "mesh/inside.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "math/random.hpp"
#include "mesh/build.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

double box_distance(const Vec3& p, const Vec3& half) {
  const Vec3 q = p.cwiseAbs() - half;
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

TEST(MeshQuery, DistanceToABoxHasItsClosedForm) {
  const Vec3 half(1e-3, 2e-3, 3e-3);
  const MeshQuery query(box_mesh(-half, half));
  Random random(1, Stream::test, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = 5e-3 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    EXPECT_NEAR(query.signed_distance(p), box_distance(p, half), 1e-15);
    EXPECT_EQ(query.inside(p), box_distance(p, half) <= 0);
  }
}

TEST(MeshQuery, InsideAgreesWithTheWindingNumberInANonConvexBody) {
  const TriangleMesh ring = revolved({{1, -1}, {2, -1}, {2, 1}, {1, 1}}, 17);
  const MeshQuery query(ring);
  Random random(2, Stream::test, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5), random.uniform(-1.5, 1.5));
    EXPECT_EQ(query.inside(p), winding_number(ring, p) > 0.5);
  }
}

TEST(MeshQuery, RayMeetsTheWallsInOrder) {
  const MeshQuery query(revolved({{1, -1}, {2, -1}, {2, 1}, {1, 1}}, 16));
  // through the middle of facets, half a facet round
  const double a = kPi / 16, c = std::cos(a);
  const Vec3 along(std::cos(a), std::sin(a), 0);
  const std::vector<RayHit> hits = query.ray(-3 * along + Vec3(0, 0, 0.1), along);
  ASSERT_EQ(hits.size(), 4u);
  const double expected[] = {3 - 2 * c, 3 - c, 3 + c, 3 + 2 * c};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(hits[i].distance, expected[i], 1e-12);
}

TEST(Topology, PiecesAndOrientation) {
  TriangleMesh two =
      merged(box_mesh(Vec3::Zero(), Vec3::Ones()), box_mesh(Vec3::Constant(2), Vec3::Constant(3)));
  EXPECT_EQ(pieces(two).count, 2);
  EXPECT_EQ(split(two, pieces(two))[1].vertices.size(), 8u);
  EXPECT_EQ(orient_alike(two), 0);
  std::swap(two.triangles[5][0], two.triangles[5][1]);
  EXPECT_EQ(orient_alike(two), 1);
}

// A strip of five triangles closed with a half turn.
TEST(Topology, MobiusStripHasOneSide) {
  TriangleMesh strip;
  for (int i = 0; i < 5; ++i) strip.vertices.emplace_back(i, i * i, i * i * i);
  for (std::int32_t i = 0; i < 5; ++i) strip.triangles.push_back({i, (i + 1) % 5, (i + 2) % 5});
  EXPECT_EQ(orient_alike(strip), -1);
}

}  // namespace
}  // namespace packbed
