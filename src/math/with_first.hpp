#pragma once
#include <cstddef>

namespace packbed {

/// The k-th of 0, 1, 2, ... when `first` is asked before all others, which keep their order. `first` must
/// stay the same while k runs.
inline std::size_t with_first(std::size_t first, std::size_t k) {
  return k == 0 ? first : k <= first ? k - 1 : k;
}

}  // namespace packbed
