#pragma once
// Threads inside a phase: [0, n) is split, and since each index writes its own place, who computes never
// changes what is computed.
#include <cstddef>
#include <functional>

namespace packbed {

/// Number of threads that parallel_for uses from now on (at least 1). One thread runs inline and starts no
/// pool.
void set_threads(int count);
int threads();

/// Calls body(begin, end) on disjoint ranges that cover [0, n), one a thread. Ranges shorter than `grain` are
/// not split.
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);
/// The same where some indices cost far more than others: smaller ranges, and a thread that has none left
/// takes from another.
void parallel_for_uneven(std::size_t n, std::size_t grain,
                         const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace packbed
