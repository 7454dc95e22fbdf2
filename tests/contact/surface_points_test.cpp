#include "contact/surface_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "../shapes.hpp"
#include "mesh/inside.hpp"

namespace packbed {
namespace {

double total(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0);
}

std::shared_ptr<Shape> a38_mesh(int facets, int rings = 1) {
  return test::mesh_body(test::prism(1.71e-3, 1.73e-3, facets, rings), test::a38()->volume, 3.42e-3);
}

TEST(SurfacePoints, WeightsOfASphereAddUpToAreaAndCurvature) {
  const double r = 2e-3;  // area / R + kCurved 2/R area
  EXPECT_NEAR(total(sample_surface(*test::sphere(r), 0.3e-3).weight), 4 * kPi * r * (1 + 2 * kCurved), 1e-12);
}

TEST(SurfacePoints, WeightsOfACylinderAddUp) {
  const double r = 1.71e-3, h = 1.73e-3;
  const double expected = 2 * kPi * r + 4 * kPi * h * (1 + kCurved) + 4 * kPi * r;  // caps, side, rims
  EXPECT_NEAR(total(sample_surface(*test::a38(), 0.25e-3).weight), expected, 1e-9 * expected);
}

TEST(SurfacePoints, AMeshOfACylinderHasTheWeightsOfTheCylinder) {  // whatever its triangles are like
  const double exact = total(sample_surface(*test::a38(), 0.25e-3).weight);
  const double size = size_radius(*a38_mesh(48)) / 1.71e-3;  // areas are made lengths by another radius
  EXPECT_NEAR(total(sample_surface(*a38_mesh(48), 0.25e-3).weight), exact, (size - 1 + 0.01) * exact);
  const double coarse = total(sample_surface(*a38_mesh(48, 1), 0.25e-3).weight),
               fine = total(sample_surface(*a38_mesh(48, 20), 0.25e-3).weight);
  EXPECT_NEAR(fine, coarse, 1e-9 * coarse);
}

TEST(SurfacePoints, WeightsOfABoxAddUpToFacesEdgesAndCorners) {
  const auto box = test::mesh_body(test::box({1e-3, 1.5e-3, 2e-3}), 24e-9, 2e-3);
  const double size = size_radius(*box);
  const double expected =
      2 * (6 + 8 + 12) * 1e-6 / size + kEdge * kPi / 2 * 4 * 9e-3 + 8 * kCorner * size * kPi / 2;
  EXPECT_NEAR(total(sample_surface(*box, 0.25e-3).weight), expected, 1e-9 * expected);
}

TEST(SurfacePoints, LieOnTheSurfaceAndCoverIt) {
  const auto shape = a38_mesh(48);
  const MeshQuery query(shape->surface);
  const SurfacePoints p = sample_surface(*shape, 0.25e-3);
  EXPECT_LT(p.cover, 0.35e-3);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_NEAR(query.signed_distance({p.x[i], p.y[i], p.z[i]}), 0, 1e-12);
  for (const double height : {-1.73e-3, 1.73e-3})  // caps
    for (double x = -1.6e-3; x < 1.7e-3; x += 0.11e-3)
      for (double y = -1.6e-3; y < 1.7e-3; y += 0.13e-3) {
        if (std::hypot(x, y) > 1.7e-3) continue;
        double nearest = 1;
        for (std::size_t i = 0; i < p.size(); ++i)
          nearest = std::min(nearest, (Vec3(p.x[i], p.y[i], p.z[i]) - Vec3(x, y, height)).norm());
        EXPECT_LE(nearest, p.cover);
      }
}

TEST(SurfacePoints, ClustersHoldTheirPointsAndOneSpotOnly) {
  const SurfacePoints p = sample_surface(*a38_mesh(48), 0.25e-3);
  ASSERT_EQ(p.size(), p.clusters() * kCluster);
  double mean = 0;
  for (std::size_t c = 0; c < p.clusters(); ++c) {
    mean += p.cluster_radius[c] / static_cast<double>(p.clusters());
    for (std::size_t i = c * kCluster; i < (c + 1) * kCluster; ++i)
      EXPECT_LE((Vec3(p.x[i], p.y[i], p.z[i]) - Vec3(p.cluster_x[c], p.cluster_y[c], p.cluster_z[c])).norm(),
                p.cluster_radius[c] * (1 + 1e-9));
  }
  EXPECT_LT(mean, 4 * 0.25e-3);
}

TEST(SurfacePoints, AreTheSameEachTime) {
  const SurfacePoints a = sample_surface(*a38_mesh(24), 0.3e-3), b = sample_surface(*a38_mesh(24), 0.3e-3);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.weight, b.weight);
}

}  // namespace
}  // namespace packbed
