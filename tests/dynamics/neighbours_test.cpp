// The neighbour search against trying every pair.
#include "dynamics/neighbours.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "math/random.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

struct Cloud {
  std::vector<std::uint32_t> bodies;
  std::vector<Vec3> position;
  std::vector<double> reach;
  std::vector<std::uint8_t> still;
};

Cloud random_cloud(unsigned n, const Vec3& size, double spread) {
  Cloud cloud;
  for (unsigned i = 0; i < n; ++i) {
    Random random(1, Stream::test, i);
    cloud.bodies.push_back(i);
    cloud.position.push_back(size.cwiseProduct(Vec3(random.uniform(), random.uniform(), random.uniform())));
    cloud.reach.push_back(random.uniform(1, spread) * 1e-3);
    cloud.still.push_back(random.uniform() < 0.3);
  }
  return cloud;
}

void expect_same_as_brute_force(const Cloud& cloud) {
  std::vector<BodyPair> found, expected;
  find_pairs_brute_force(cloud.bodies, cloud.position, cloud.reach, cloud.still, expected);
  for (const int threads : {1, 2, 4}) {
    set_threads(threads);
    NeighbourSearch search;
    search.find(cloud.bodies, cloud.position, cloud.reach, cloud.still, found);
    EXPECT_EQ(found, expected) << threads << " threads";
  }
  set_threads(1);
}

TEST(Neighbours, DenseCloud) {
  expect_same_as_brute_force(random_cloud(900, Vec3(0.02, 0.02, 0.02), 1.5));
}
TEST(Neighbours, ManySizes) {
  expect_same_as_brute_force(random_cloud(600, Vec3(0.05, 0.05, 0.05), 12));
}
TEST(Neighbours, FlatLayer) {
  expect_same_as_brute_force(random_cloud(500, Vec3(0.1, 0.1, 0), 2));
}
TEST(Neighbours, FarApart) {
  expect_same_as_brute_force(random_cloud(200, Vec3(100, 1e-3, 50), 2));
}
TEST(Neighbours, AllInOnePlace) {
  expect_same_as_brute_force(random_cloud(60, Vec3::Zero(), 2));
}

}  // namespace
}  // namespace packbed
