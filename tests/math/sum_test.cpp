#include "math/sum.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "math/random.hpp"
#include "math/types.hpp"

namespace packbed {
namespace {

std::vector<double> uneven_terms(
    std::size_t n) {  // of all sizes and signs, so that another order rounds otherwise
  std::vector<double> terms(n);
  Random random(5, Stream::test, 0);
  for (double& t : terms) t = random.normal() * std::pow(10.0, random.uniform(-8, 8));
  return terms;
}

TEST(FixedOrderSum, IsTheSameBitForBitForAnyNumberOfThreads) {
  for (const std::size_t n : {std::size_t{1}, std::size_t{255}, std::size_t{256}, std::size_t{100003}}) {
    const std::vector<double> terms = uneven_terms(n);
    const auto sum = [&](int count) {
      set_threads(count);
      return fixed_order_sum(n, 0.0, [&](std::size_t i) { return terms[i]; });
    };
    const double one = sum(1);
    EXPECT_EQ(one, sum(2)) << n;
    EXPECT_EQ(one, sum(4)) << n;
  }
  set_threads(1);
}

TEST(FixedOrderSum, AddsEveryTermOnce) {
  for (const std::size_t n :
       {std::size_t{0}, std::size_t{1}, std::size_t{256}, std::size_t{257}, std::size_t{5000}})
    EXPECT_EQ(fixed_order_sum(n, std::size_t{0}, [](std::size_t i) { return i; }),
              n == 0 ? 0 : n * (n - 1) / 2);
}

TEST(FixedOrderSum, AddsVectors) {
  const Vec3 sum = fixed_order_sum(1000, Vec3(Vec3::Zero()),
                                   [](std::size_t i) { return Vec3(1, static_cast<double>(i), -2); });
  EXPECT_EQ(sum, Vec3(1000, 499500, -2000));
}

}  // namespace
}  // namespace packbed
