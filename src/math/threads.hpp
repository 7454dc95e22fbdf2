#pragma once
// Threads inside a phase: a static split of [0, n), so that who computes never changes what is computed.
#include <cstddef>
#include <functional>

namespace packbed {

/// Number of threads that parallel_for uses from now on (at least 1). One thread runs inline and starts no
/// pool.
void set_threads(int count);
int threads();

/// Calls body(begin, end) on disjoint ranges that cover [0, n). Ranges shorter than `grain` are not split.
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace packbed
