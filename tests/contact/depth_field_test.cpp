#include "contact/depth_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../shapes.hpp"
#include "math/random.hpp"
#include "mesh/inside.hpp"
#include "mesh/triangle_tree.hpp"

namespace packbed {
namespace {

constexpr double kD = 3.42e-3;

TriangleMesh a38_mesh(int facets = 48) {
  return test::prism(1.71e-3, 1.73e-3, facets);
}

Vec3 random_point(Random& random, double half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

TEST(TriangleTree, AgreesWithTheExactOracleInDistanceAndSign) {
  for (const TriangleMesh& mesh : {a38_mesh(24), test::square_cup(1.2e-3, 2e-3, 0.3e-3)}) {
    const TriangleTree tree(mesh);
    const MeshQuery oracle(mesh);
    Random random(1, Stream::test, 0);
    for (int i = 0; i < 5000; ++i) {
      const Vec3 x = random_point(random, 2.2e-3);
      EXPECT_NEAR(tree.signed_distance(x), oracle.signed_distance(x), 1e-15);
    }
  }
}

TEST(TriangleTree, FindsNothingBeyondTheBound) {
  const TriangleTree tree(a38_mesh());
  EXPECT_EQ(tree.nearest({0, 0, 3.73e-3}, 1.9e-3).triangle, -1);
  EXPECT_NEAR(tree.nearest({0, 0, 3.73e-3}, 2.1e-3).distance, 2e-3, 1e-15);
}

// A room 40 x 40 x 60 mm: each side and the floor are cut into two triangles along a diagonal.
TEST(TriangleTree, SeesOnePlaceOnAFaceAndOneMoreForEachWallOfACorner) {
  const TriangleTree tree(test::square_cup(20e-3, 60e-3, 1e-3));
  std::vector<TriangleTree::Nearest> places;
  Random random(2, Stream::test, 0);
  for (int i = 0; i < 2000; ++i) {
    Vec3 x(random.uniform(-19.9e-3, 19.9e-3), random.uniform(-19.9e-3, 19.9e-3),
           random.uniform(0.1e-3, 30e-3));
    if (i % 3 == 0) x.y() = -x.x() + (i % 2) * 1e-9;  // over the diagonal of the floor, and just beside it
    if (i % 5 == 0) x.x() = 20e-3 - 1e-4;
    tree.nearest_places(x, 2e-3, places);
    std::vector<double> walls;
    for (const double d : {20e-3 - x.x(), 20e-3 + x.x(), 20e-3 - x.y(), 20e-3 + x.y(), x.z()})
      if (d < 2e-3) walls.push_back(d);
    std::sort(walls.begin(), walls.end());
    ASSERT_EQ(places.size(), walls.size()) << x.transpose();
    for (std::size_t k = 0; k < walls.size(); ++k) EXPECT_NEAR(places[k].distance, walls[k], 1e-15);
  }
  tree.nearest_places({0, 0, -0.4e-3}, 2e-3, places);  // in the material of the floor
  ASSERT_EQ(places.size(), 1U);
  EXPECT_NEAR(places[0].distance, -0.4e-3, 1e-15);
  tree.nearest_places({0, 20.3e-3, 60.4e-3}, 2e-3, places);  // over the rim
  ASSERT_EQ(places.size(), 1U);
  EXPECT_NEAR(places[0].distance, 0.4e-3, 1e-15);
}

TEST(DepthField, IsZeroOnTheSurfaceAndOutsideAndOfUnitSlopeThere) {
  const DepthField sphere = DepthField::of_sphere(2e-3), rod = DepthField::of_cylinder(1.71e-3, 1.73e-3);
  const DepthField mesh = DepthField::of_mesh(a38_mesh(), kD / 40);
  const double facet = 1.71e-3 * std::sqrt(2 * kPi / 48 / std::sin(2 * kPi / 48)) * std::cos(kPi / 48);
  struct Case {
    const DepthField& field;
    Vec3 surface, inward;
    double tolerance;
  };
  const Vec3 out(std::cos(kPi / 48), std::sin(kPi / 48), 0);  // middle of a facet
  for (const Case& c :
       {Case{sphere, {0, 2e-3, 0}, {0, -1, 0}, 1e-12}, Case{rod, {0.3e-3, 0, 1.73e-3}, {0, 0, -1}, 1e-9},
        Case{rod, {1.71e-3, 0, 0.2e-3}, {-1, 0, 0}, 1e-9}, Case{mesh, {0.3e-3, 0, 1.73e-3}, {0, 0, -1}, 1e-9},
        Case{mesh, facet * out, -out, 2e-6}}) {
    Vec3 gradient;
    EXPECT_NEAR(c.field.depth(c.surface + 1e-9 * c.inward, &gradient), 1e-9, 1e-9 * 1e-3 + c.tolerance);
    EXPECT_NEAR((gradient - c.inward).norm(), 0, c.tolerance > 1e-8 ? 0.05 : 1e-5);
    EXPECT_EQ(c.field.depth(c.surface - 0.01e-3 * c.inward), 0);
    EXPECT_EQ(c.field.depth(c.surface - 5e-3 * c.inward), 0);
  }
}

TEST(DepthField, GradientIsThatOfTheDepth) {
  Random random(2, Stream::test, 0);
  for (const DepthField& field : {DepthField::of_sphere(1.9e-3), DepthField::of_cylinder(1.71e-3, 1.73e-3),
                                  DepthField::of_mesh(a38_mesh(), kD / 32)}) {
    for (int i = 0; i < 500; ++i) {
      const Vec3 x = random_point(random, 1.6e-3);
      Vec3 gradient;
      if (!(field.depth(x, &gradient) > 1e-5)) continue;
      const double step = 1e-9;
      for (int k = 0; k < 3; ++k) {
        const Vec3 dx = step * Vec3::Unit(k);
        EXPECT_NEAR((field.depth(x + dx) - field.depth(x - dx)) / (2 * step), gradient[k], 1e-5);
      }
    }
  }
}

TEST(DepthField, GridHasNoJumpsInDepthOrGradient) {  // along lines through many cells and blocks
  const DepthField field = DepthField::of_mesh(a38_mesh(), kD / 32);
  const Vec3 from(-1.5e-3, -1.1e-3, -1.6e-3), to(1.4e-3, 1.3e-3, 1.5e-3);
  const int n = 20000;
  double last_depth = 0;
  Vec3 last_gradient = Vec3::Zero();
  for (int i = 0; i <= n; ++i) {
    Vec3 gradient;
    const double depth = field.depth(from + (to - from) * (static_cast<double>(i) / n), &gradient);
    const double step = (to - from).norm() / n;
    if (depth > 0 && last_depth > 0) {
      EXPECT_LT(std::abs(depth - last_depth), 2 * step);
      EXPECT_LT((gradient - last_gradient).norm(), 60 * step / (kD / 32) * 0.1 + 1e-6);
    }
    last_depth = depth;
    last_gradient = gradient;
  }
}

TEST(DepthField, EdgesAreSharpToASmallPartOfTheSpacing) {
  const double spacing = 0.1e-3;
  const DepthField field = DepthField::of_mesh(test::box({1e-3, 1.1e-3, 1.2e-3}), spacing);
  Random random(5, Stream::test, 0);
  for (int i = 0; i < 500; ++i) {
    const double depth = random.uniform(0.05, 0.4) * spacing, along = random.uniform(-0.8e-3, 0.8e-3);
    const Vec3 edge(1e-3 - depth, 1.1e-3 - depth, along), rim(along, 1.1e-3 - depth, -1.2e-3 + depth);
    EXPECT_NEAR(field.depth(edge), depth, 0.06 * spacing);
    EXPECT_NEAR(field.depth(rim), depth, 0.06 * spacing);
  }
}

/// Root mean square and largest error of the depth in the outer 5 % of the diameter [m].
std::pair<double, double> value_error(const TriangleMesh& mesh, double spacing) {
  const DepthField field = DepthField::of_mesh(mesh, spacing);
  const MeshQuery oracle(mesh);
  Random random(3, Stream::test, 0);
  double sum = 0, most = 0;
  int n = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x = random_point(random, 1.75e-3);
    const double d = oracle.signed_distance(x);
    if (d > 0 || d < -0.05 * kD) continue;
    const double error = field.depth(x) + d;
    sum += error * error;
    most = std::max(most, std::abs(error));
    ++n;
  }
  return {std::sqrt(sum / n), most};
}

TEST(DepthField, GridErrorIsFarBelowItsSpacingAndFallsWithIt) {
  const TriangleMesh mesh = a38_mesh();
  double last = 1;
  for (const double across : {24.0, 32.0, 48.0, 64.0}) {
    const auto [mean, most] = value_error(mesh, kD / across);
    std::printf("[   field  ] spacing D/%.0f: depth error rms %.2e D, largest %.2e D, %.2f MB\n", across,
                mean / kD, most / kD,
                static_cast<double>(DepthField::of_mesh(mesh, kD / across).bytes()) / 1e6);
    EXPECT_LT(mean, 0.03 * kD / across);
    EXPECT_LT(most, 0.25 * kD / across);  // in the rounded edges
    EXPECT_LT(mean, last);
    last = mean;
  }
}

TEST(DepthField, NearNeverLeavesOutAPointThatIsInside) {
  const DepthField grid = DepthField::of_mesh(a38_mesh(), kD / 32),
                   rod = DepthField::of_cylinder(1.71e-3, 1.73e-3), sphere = DepthField::of_sphere(1.8e-3);
  const TriangleTree tree(a38_mesh());
  for (const DepthField* field : {&grid, &rod, &sphere}) {
    Random random(4, Stream::test, 0);
    int left_out = 0, inside = 0;
    for (int round = 0; round < 100; ++round) {
      double x[100], y[100], z[100], radius[100] = {}, apart = 0;
      for (int i = 0; i < 100; ++i) {
        const Vec3 p = random_point(random, 6e-3);
        x[i] = p.x(), y[i] = p.y(), z[i] = p.z();
      }
      std::uint16_t index[100];
      const std::size_t n = field->near(x, y, z, radius, 100, index, &apart);
      std::vector<bool> listed(100, false);
      for (std::size_t k = 0; k < n; ++k) listed[index[k]] = true;
      for (std::size_t i = 0; i < 100; ++i) {
        const bool in = field->depth({x[i], y[i], z[i]}) > 0;
        EXPECT_TRUE(listed[i] || !in);
        inside += in;
        left_out += !listed[i];
      }
    }
    EXPECT_GT(inside, 50);
    EXPECT_GT(left_out, 8000);  // 94 % of the points are outside
  }
}

TEST(DepthField, DepthsEndAtThePlateauInAThickWall) {
  const TriangleMesh block = test::box({5e-3, 5e-3, 5e-3});
  const DepthField field = DepthField::of_mesh(block, 0.25e-3, 0.8e-3);
  EXPECT_NEAR(field.depth({0, 0, 4.8e-3}), 0.2e-3, 1e-8);
  Vec3 gradient;
  EXPECT_NEAR(field.depth({0, 0, 0}, &gradient), 0.8e-3, 1e-8);
  EXPECT_EQ(gradient, Vec3::Zero());
  EXPECT_LT(field.bytes(), DepthField::of_mesh(block, 0.25e-3).bytes());
}

TEST(DepthField, MemoryIsEstimatedWithinAFactorOfTwo) {
  const TriangleMesh cup = test::square_cup(20e-3, 60e-3, 6e-3);
  for (const double spacing : {0.8e-3, 1.2e-3}) {
    const double bytes = static_cast<double>(DepthField::of_mesh(cup, spacing, 0.8e-3).bytes());
    const double estimate = DepthField::estimate_bytes(cup, spacing, 0.8e-3);
    EXPECT_LT(bytes, 2 * estimate);
    EXPECT_GT(bytes, 0.5 * estimate);
  }
}

}  // namespace
}  // namespace packbed
