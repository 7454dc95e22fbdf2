#pragma once
// A sum whose order does not depend on the number of threads: blocks of 256 added in turn, then the blocks in
// turn.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "math/threads.hpp"

namespace packbed {

/// term(i) for i in [0, n), summed in fixed order. T needs +=; zero is the value of an empty sum.
template <class T, class Term>
T fixed_order_sum(std::size_t n, const T& zero, const Term& term) {
  constexpr std::size_t kBlock = 256;
  std::vector<T> partial((n + kBlock - 1) / kBlock, zero);
  parallel_for(partial.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      for (std::size_t i = b * kBlock; i < std::min(n, (b + 1) * kBlock); ++i) partial[b] += term(i);
  });
  T total = zero;
  for (const T& p : partial) total += p;
  return total;
}

}  // namespace packbed
