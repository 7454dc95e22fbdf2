#pragma once
// The loops of the lattice: a stamp against the window of the lattice that it lies on, word by word, eight
// rows at a time. Bits only, so that wide and narrow machines agree.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace packbed {

/// The 64 bits from bit x, negative or not, of a row whose words word(w) gives, also beyond its ends.
template <class Word>
std::uint64_t bits_from(int x, const Word& word) {
  const int w = x >= 0 ? x / 64 : -((63 - x) / 64), shift = x - 64 * w;
  return (word(w) >> shift) | ((word(w + 1) << 1) << (63 - shift));
}

/// Rows of a slice, by eights, all of them rows of the box.
struct RowRange {
  std::uint16_t first = 0, eights = 0;
  int end() const { return first + 8 * eights; }
};

/// Where the words of a stamp meet the words of the lattice.
struct Window {
  std::uint64_t* lattice = nullptr;           // word of the first row, word and slice
  std::size_t lattice_column, lattice_slice;  // words from one x-word, one slice, to the next
  int shift;                                  // bits of x that the stamp is moved by within a word
  const std::uint64_t* stamp = nullptr;       // first row, word and slice of the stamp
  std::size_t stamp_column, stamp_slice;
  int slices, words;
  bool narrow;             // the bits lie in one word of the lattice
  const RowRange* ranges;  // rows of each slice that have cells, and one more on either side
};

/// Whether any bit of the stamp is set in the lattice.
bool window_hits(const Window& w);
/// The same for the bits that a move by one cell along `axis` would newly enter.
bool window_hits_ahead(const Window& w, int axis, int sign);
/// Number of bits of the stamp that are set in the lattice.
std::int64_t window_count(const Window& w);
/// Exclusive-or of the stamp into the lattice: writes a pellet that is not there, erases one that is.
void window_flip(const Window& w);
/// The flip of the stamp and of the stamp moved by one cell along y (axis 1) or z (2), in one go.
void window_move(const Window& w, int axis, int sign);
/// Or of the stamp into the lattice.
void window_write(const Window& w);

/// Cells of one word of a window.
struct HitRow {
  std::uint64_t bits = 0;
  std::int32_t word = 0, row = 0, slice = 0;  // of the window
};
/// The rows of a window that share cells with the lattice, into `out`, which has room for all rows of the
/// ranges in all words; returns their number.
std::size_t window_list(const Window& w, HitRow* out);
/// Words of one column of a lattice, slice by slice.
struct Columns {
  std::uint64_t* first = nullptr;  // row, slice 0
  std::size_t column, slice;       // words from one x-word, one slice, to the next
};
/// Copies `rows` rows, a multiple of eight, of so many slices, without the first `shift` bits of x, which
/// come from the next word instead.
void window_copy(const Columns& from, int shift, int slices, int rows, const Columns& to);

/// Taken cells that a pellet meets, by words of its stamp; keeps its memory between calls.
class Hits {
 public:
  std::span<const HitRow> rows() const { return {rows_.data(), count_}; }
  void clear() { count_ = 0; }
  /// Those of a window; true when there are any.
  bool list(const Window& w) {
    const std::size_t most = w.stamp_column * static_cast<std::size_t>(w.slices * w.words);
    if (rows_.size() < most) rows_.resize(most);
    count_ = window_list(w, rows_.data());
    return count_ > 0;
  }

 private:
  std::vector<HitRow> rows_;
  std::size_t count_ = 0;
};

}  // namespace packbed
