#pragma once
// What is taken on a lattice, one bit a cell: the container's wall and all pellets that have been laid on it.
// Everything outside counts as wall.
#include <bit>
#include <vector>

#include "lattice/stamp.hpp"
#include "lattice/voxel_grid.hpp"
#include "lattice/window.hpp"

namespace packbed {

class Occupancy {
 public:
  /// `frame`: the cells of the lattice. `space`: which of them are open, slice by slice; one slice stands for
  /// all; slices above the last one of `space` are open like `rim`, the slice of `space` that the pellets
  /// come in through.
  Occupancy(const GridFrame& frame, const VoxelGrid& space, int rim = 0);

  /// Whether a pellet in this cell shares a cell with another one or the wall. The pellet itself must not be
  /// on the lattice.
  bool hits(const Stamp& stamp, const Cell& at) const;
  /// Whether a pellet that is in `at` would, moved by one cell (`sign` 1 or -1) along `axis`. Looks only at
  /// cells that it would newly enter.
  bool hits_on_move(const Stamp& stamp, const Cell& at, int axis, int sign) const;
  /// Calls visit(x, y, z), counted from the pellet's cell, for every taken cell that such a move would enter.
  /// Cells outside of the lattice's margin are not visited.
  template <class Visit>
  void for_each_hit_on_move(const Stamp& stamp, const Cell& at, int axis, int sign, const Visit& visit) const;
  /// The same for every taken cell of a pellet that is not on the lattice.
  template <class Visit>
  void for_each_hit(const Stamp& stamp, const Cell& at, const Visit& visit) const;
  /// Number of its cells that are taken; those outside of the lattice count as one.
  std::int64_t shared(const Stamp& stamp, const Cell& at) const;
  /// Lays a pellet on free cells, or takes it off.
  void flip(const Stamp& stamp, const Cell& at);
  /// Lays a pellet on any cells, taken or not.
  void write(const Stamp& stamp, const Cell& at);
  /// Moves a pellet that is on the lattice by one cell.
  void move(const Stamp& stamp, Cell& at, int axis, int sign);
  bool taken(const Cell& cell) const;
  /// Bits of the 64 cells from (x, y, z) along x; all set outside of the lattice.
  std::uint64_t taken_from(int x, int y, int z) const;

  const GridFrame& frame() const { return frame_; }
  std::int64_t open_cells() const { return open_; }  ///< when nothing is on it
  std::int64_t count_open() const;                   ///< now
  std::size_t bytes() const { return bits_.size() * sizeof(std::uint64_t); }

 private:
  bool inside(const Stamp& stamp, const Cell& at) const;
  Window window(const Stamp& stamp, const Cell& at) const;
  std::uint64_t& word(int x, int y, int z);

  GridFrame frame_;
  std::size_t column_, slice_;  // words from one x-word, one slice, to the next
  std::int64_t open_ = 0;
  std::vector<std::uint64_t> bits_;  // (slices, words, rows), a margin of wall all round
};

template <class Visit>
void Occupancy::for_each_hit(const Stamp& stamp, const Cell& at, const Visit& visit) const {
  if (!inside(stamp, at)) return;
  const Window w = window(stamp, at);
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x)
      for (int y = 0; y < w.rows; ++y)
        for (std::uint64_t bits = window_word(w, x, y, z); bits; bits &= bits - 1)
          visit(stamp.low[0] + 64 * x + std::countr_zero(bits), stamp.low[1] + y, stamp.low[2] + z);
}

template <class Visit>
void Occupancy::for_each_hit_on_move(const Stamp& stamp, const Cell& at, int axis, int sign,
                                     const Visit& visit) const {
  Cell to = at;
  to[static_cast<std::size_t>(axis)] += sign;
  if (!inside(stamp, to)) return;
  const Window w = window(stamp, at);
  std::vector<std::uint64_t> found(stamp.column());
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x) {
      if (!window_column_ahead(w, x, z, axis, sign, found.data())) continue;
      for (int y = 0; y < w.rows; ++y)
        for (std::uint64_t bits = found[static_cast<std::size_t>(y)]; bits; bits &= bits - 1)
          visit(stamp.low[0] + 64 * x + std::countr_zero(bits), stamp.low[1] + y, stamp.low[2] + z);
    }
}

}  // namespace packbed
