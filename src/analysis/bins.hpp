#pragma once
// Values gathered in bins over many bodies, in an order that does not depend on the number of threads.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "math/threads.hpp"

namespace packbed {

/// gather(i, bins) adds what body i has to give to `bins` (n_bins); blocks of 64 bodies, then the blocks in
/// turn.
template <class Gather>
std::vector<double> gather_in_bins(std::size_t bodies, std::size_t n_bins, const Gather& gather) {
  constexpr std::size_t kBlock = 64;
  std::vector<std::vector<double>> blocks((bodies + kBlock - 1) / kBlock);
  parallel_for(blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      blocks[b].assign(n_bins, 0.0);
      for (std::size_t i = b * kBlock; i < std::min(bodies, (b + 1) * kBlock); ++i) gather(i, blocks[b]);
    }
  });
  std::vector<double> bins(n_bins, 0.0);
  for (const auto& block : blocks)
    for (std::size_t k = 0; k < n_bins; ++k) bins[k] += block[k];
  return bins;
}

/// Bin of ascending edges that x lies in; edges.size() - 1 bins, values outside go to the first or last.
inline std::size_t bin_of(const std::vector<double>& edges, double x) {
  const auto above = std::upper_bound(edges.begin(), edges.end(), x) - edges.begin();
  return static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - 1, 0, static_cast<std::ptrdiff_t>(edges.size()) - 2));
}

}  // namespace packbed
