#pragma once
// The lattice round one pellet, copied without the pellet: all moves of its turn are tried on the copy, which
// stays in the nearest cache, and in which the pellet does not stand in its own way.
#include <vector>

#include "lattice/occupancy.hpp"

namespace packbed {

class Surroundings {
 public:
  /// Copies the cells within `reach` cells of the pellet `own`, which lies in the cell `at`.
  void look(const Occupancy& lattice, const Stamp& own, const Cell& at, int reach);
  /// Whether a cell, counted from the one looked at, is taken; one beyond the copy counts as taken.
  bool taken(const Cell& cell) const {
    std::size_t at[3];
    for (std::size_t d = 0; d < 3; ++d) {
      const int c = cell[d] + reach_;
      if (c < 0 || c > 2 * reach_) return true;
      at[d] = static_cast<std::size_t>(c);
    }
    const std::size_t column = static_cast<std::size_t>(rows_),
                      slice = column * static_cast<std::size_t>(words_ + 1);
    return (bits_[at[2] * slice + at[0] / 64 * column + at[1]] >> (at[0] % 64)) & 1U;
  }
  /// Whether a pellet whose cell is `moved` from the one looked at would share a cell, or reach beyond the
  /// copy.
  bool hits(const Stamp& stamp, const Cell& moved) const;
  /// Fills `found` with the cells that a pellet would share whose cell is `moved` from the one looked at.
  /// False, and none, when it is free; true and none when it would reach beyond the copy.
  bool list_hits(const Stamp& stamp, const Cell& moved, Hits& found) const;

 private:
  bool holds(const Stamp& stamp, const Cell& moved) const;
  Window window(const Stamp& stamp, const Cell& moved) const;

  int reach_ = 0, rows_ = 0, words_ = 0;
  std::vector<std::uint64_t> bits_;  // (slices, words and one more, rows)
};

}  // namespace packbed
