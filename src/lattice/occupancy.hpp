#pragma once
// What is taken on a lattice, one bit a cell: the container's wall and all pellets that have been laid on it.
// Everything outside counts as wall.
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
  /// Number of its cells that are taken; those outside of the lattice count as one.
  std::int64_t shared(const Stamp& stamp, const Cell& at) const;
  /// Lays a pellet on free cells, or takes it off.
  void flip(const Stamp& stamp, const Cell& at);
  /// Lays a pellet on any cells, taken or not.
  void write(const Stamp& stamp, const Cell& at);
  /// Moves a pellet that is on the lattice by one cell.
  void move(const Stamp& stamp, Cell& at, int axis, int sign);
  bool taken(const Cell& cell) const;
  /// Taken cells of a box from `low` upwards, of `rows` rows, a multiple of eight, into words `column` and
  /// `slice` from one x-word, one slice, to the next; all set outside of the lattice.
  void copy(const Cell& low, int slices, int words, int rows, std::uint64_t* out, std::size_t column,
            std::size_t slice) const;
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

}  // namespace packbed
