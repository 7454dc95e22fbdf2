// The search of spheres of very different sizes against trying every pair.
#include "dynamics/level_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/random.hpp"

namespace packbed {
namespace {

using Found = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Found by_grid(const std::vector<Quad>& spheres) {
  const LevelGrid grid(spheres);
  Found found;
  for (std::uint32_t i = 0; i < spheres.size(); ++i)
    grid.for_each_near(i, [&](std::uint32_t j) { found.push_back(std::minmax(i, j)); });
  std::sort(found.begin(), found.end());
  return found;
}

Found by_trying(const std::vector<Quad>& s) {
  Found found;
  for (std::uint32_t i = 0; i < s.size(); ++i)
    for (std::uint32_t j = i + 1; j < s.size(); ++j) {
      const double reach = s[i].w + s[j].w;
      if (std::hypot(s[i].x - s[j].x, s[i].y - s[j].y, s[i].z - s[j].z) < reach) found.push_back({i, j});
    }
  return found;
}

/// Sizes evenly spread in their logarithm, so that all levels are filled.
std::vector<Quad> cloud(std::uint32_t n, const Vec3& box, double ratio) {
  std::vector<Quad> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    Random random(3, Stream::test, i);
    const double reach = 1e-3 * std::pow(ratio, random.uniform());
    spheres.push_back(
        {box.x() * random.uniform(), box.y() * random.uniform(), box.z() * random.uniform(), reach});
  }
  return spheres;
}

class SizeRatio : public testing::TestWithParam<double> {};

TEST_P(SizeRatio, DoesNotChangeWhatIsFound) {
  const std::vector<Quad> spheres = cloud(3000, {0.1, 0.08, 0.2}, GetParam());
  const Found found = by_grid(spheres);
  EXPECT_GT(found.size(), 50U);
  EXPECT_EQ(found, by_trying(spheres));
  EXPECT_EQ(LevelGrid(spheres).levels(), static_cast<std::size_t>(std::log2(GetParam())) + 1);
}

INSTANTIATE_TEST_SUITE_P(Of, SizeRatio, testing::Values(1.0, 3.0, 10.0, 35.0),
                         [](const auto& of) { return std::to_string(static_cast<int>(of.param)); });

TEST(LevelGrid, FindsInALineInALayerAndFarAway) {
  for (const Vec3& box : {Vec3(0, 0, 2), Vec3(0.3, 0.3, 0), Vec3(0, 0, 0)}) {
    std::vector<Quad> spheres = cloud(400, box, 10);
    spheres.push_back({1e3, -1e3, 5e3, 1e-3});  // one that has escaped
    EXPECT_EQ(by_grid(spheres), by_trying(spheres));
  }
}

TEST(LevelGrid, OfNothingAndOfOne) {
  EXPECT_TRUE(by_grid({}).empty());
  EXPECT_TRUE(by_grid({{0, 0, 0, 1}}).empty());
}

}  // namespace
}  // namespace packbed
