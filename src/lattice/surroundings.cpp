#include "lattice/surroundings.hpp"

#include "lattice/words8.hpp"

namespace packbed {

void Surroundings::look(const Occupancy& lattice, const Stamp& own, const Cell& at, int reach) {
  reach_ = reach;
  const int size = 2 * reach + 1;
  const int eights = (size + kWords8 - 1) / kWords8 * kWords8;
  rows_ = eights + kWords8;  // a window may read beyond the last row, a whole eight of rows
  words_ = (size + 63) / 64;
  const std::size_t column = static_cast<std::size_t>(rows_),
                    slice = column * static_cast<std::size_t>(words_ + 1);
  bits_.resize(static_cast<std::size_t>(size) * slice);
  lattice.copy({at[0] - reach, at[1] - reach, at[2] - reach}, size, words_, eights, bits_.data(), column,
               slice);
  window_flip(window(own, {0, 0, 0}));
}

Window Surroundings::window(const Stamp& stamp, const Cell& moved) const {
  const std::size_t column = static_cast<std::size_t>(rows_);
  return window_of(stamp, const_cast<std::uint64_t*>(bits_.data()), column,
                   column * static_cast<std::size_t>(words_ + 1), reach_ + moved[0] + stamp.low[0],
                   reach_ + moved[1] + stamp.low[1], reach_ + moved[2] + stamp.low[2]);
}

bool Surroundings::holds(const Stamp& stamp, const Cell& moved) const {
  for (std::size_t d = 0; d < 3; ++d) {
    const int low = reach_ + moved[d] + stamp.low[d];
    if (low < 0 || low + stamp.size[d] > 2 * reach_ + 1) return false;
  }
  return true;
}

bool Surroundings::hits(const Stamp& stamp, const Cell& moved) const {
  return !holds(stamp, moved) || window_hits(window(stamp, moved));
}

bool Surroundings::list_hits(const Stamp& stamp, const Cell& moved, Hits& found) const {
  found.clear();
  return !holds(stamp, moved) || found.list(window(stamp, moved));
}

}  // namespace packbed
