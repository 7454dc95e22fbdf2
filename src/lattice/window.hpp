#pragma once
// The loops of the lattice: a stamp against the window of the lattice that it lies on, word by word, eight
// rows at a time. Bits only, so that wide and narrow machines agree.
#include <cstddef>
#include <cstdint>

namespace packbed {

/// Where the words of a stamp meet the words of the lattice.
struct Window {
  std::uint64_t* lattice = nullptr;           // word of the first row, word and slice
  std::size_t lattice_column, lattice_slice;  // words from one x-word, one slice, to the next
  int shift;                                  // bits of x that the stamp is moved by within a word
  const std::uint64_t* stamp = nullptr;       // first row, word and slice of the stamp
  std::size_t stamp_column, stamp_slice;
  int slices, words, rows;
};

/// Whether any bit of the stamp is set in the lattice.
bool window_hits(const Window& w);
/// The same for the bits that stamp moved by `step` words has and the stamp has not (y: one row; z: one
/// slice).
bool window_hits_ahead(const Window& w, std::ptrdiff_t step);
/// The same for a move by one bit along x, up or down.
bool window_hits_ahead_x(const Window& w, bool up);
/// One column of rows of what a move by one cell along `axis` would enter and finds taken, into found[rows].
/// False when there is none.
bool window_column_ahead(const Window& w, int x, int z, int axis, int sign, std::uint64_t* found);
/// Number of bits of the stamp that are set in the lattice.
std::int64_t window_count(const Window& w);
/// Exclusive-or of the stamp into the lattice: writes a pellet that is not there, erases one that is.
void window_flip(const Window& w);
/// The flip of the stamp and of the stamp moved as in window_hits_ahead (y, z), in one go.
void window_move(const Window& w, std::ptrdiff_t step);
/// Or of the stamp into the lattice.
void window_write(const Window& w);

/// Bits of one word of the stamp that are set in the lattice.
inline std::uint64_t window_word(const Window& w, int x, int y, int z) {
  const std::uint64_t* low = w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
                             static_cast<std::size_t>(x) * w.lattice_column + y;
  const std::uint64_t stamp =
      w.stamp[static_cast<std::size_t>(z) * w.stamp_slice + static_cast<std::size_t>(x) * w.stamp_column +
              static_cast<std::size_t>(y)];
  return ((*low >> w.shift) | ((low[w.lattice_column] << 1) << (63 - w.shift))) & stamp;
}

}  // namespace packbed
