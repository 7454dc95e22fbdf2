#include "math/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "math/simd.hpp"

namespace packbed {
namespace {

class Threads : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { set_threads(GetParam()); }
  void TearDown() override { set_threads(1); }
};

TEST_P(Threads, VisitEachIndexOnce) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{10000}}) {
    for (const auto split : {parallel_for, parallel_for_uneven}) {
      std::vector<int> visits(n);
      split(n, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(n, 1));
    }
  }
}

TEST_P(Threads, HandExceptionsToTheCaller) {
  EXPECT_THROW(parallel_for(1000, 1,
                            [](std::size_t begin, std::size_t end) {
                              if (begin <= 500 && 500 < end) throw std::runtime_error("in a worker");
                            }),
               std::runtime_error);
}

TEST_P(Threads, DoNotSplitRangesShorterThanTheGrain) {
  std::atomic<int> calls{0};
  parallel_for(64, 64, [&](std::size_t begin, std::size_t end) {
    ++calls;
    EXPECT_EQ(end - begin, 64);
  });
  EXPECT_EQ(calls, 1);
}

TEST_P(Threads, MayNest) {
  std::vector<int> visits(400);
  parallel_for(20, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      parallel_for(20, 1, [&, i](std::size_t from, std::size_t to) {
        for (std::size_t j = from; j < to; ++j) ++visits[20 * i + j];
      });
  });
  EXPECT_EQ(visits, std::vector<int>(400, 1));
}

INSTANTIATE_TEST_SUITE_P(Of, Threads, testing::Values(1, 2, 4));

TEST(ThreadCount, IsAtLeastOne) {
  set_threads(0);
  EXPECT_EQ(threads(), 1);
  set_threads(-3);
  EXPECT_EQ(threads(), 1);
  set_threads(3);
  EXPECT_EQ(threads(), 3);
  set_threads(1);
}

PACKBED_WIDE void multiply_add(const double* a, const double* b, double* sum, int n) {
  for (int i = 0; i < n; ++i) sum[i] = a[i] * b[i] + sum[i];
}

// A fused multiply-add would keep the low half of the product: (1 + e)(1 - e) - 1 = -e^2 instead of 0.
TEST(WideVectors, RoundAsTheBaseMachineDoes) {
  const double e = 0x1.0p-30;
  std::vector<double> a(37, 1 + e), b(37, 1 - e), sum(37, -1);
  multiply_add(a.data(), b.data(), sum.data(), 37);
  EXPECT_EQ(sum, std::vector<double>(37, 0.0));
}

}  // namespace
}  // namespace packbed
