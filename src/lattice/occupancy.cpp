#include "lattice/occupancy.hpp"

#include <algorithm>
#include <bit>

namespace packbed {
namespace {

/// Cells of wall round the lattice: one for a move, one for the empty border of a stamp.
constexpr int kMargin = 2;

std::size_t size(int n) {
  return static_cast<std::size_t>(n);
}

}  // namespace

Occupancy::Occupancy(const GridFrame& frame, const VoxelGrid& space, int rim) : frame_(frame) {
  // eight rows more at the end, and one word: windows read whole lanes and two words
  column_ = (size(frame.size[1] + 2 * kMargin) + 7) / 8 * 8 + 8;
  slice_ = column_ * ((size(frame.size[0] + 2 * kMargin) + 63) / 64 + 1);
  bits_.assign(slice_ * size(frame.size[2] + 2 * kMargin), ~std::uint64_t{0});
  const int slices = space.frame.size[2];
  for (int z = 0; z < frame.size[2]; ++z) {
    const int from = slices == 1 ? 0 : z < slices ? z : rim;
    for (int y = 0; y < frame.size[1]; ++y)
      for (int w = 0; w < static_cast<int>(frame.words_per_row()); ++w) {
        const std::uint64_t open = space.words[space.row(y, from) + size(w)];
        open_ += std::popcount(open);
        for (std::uint64_t bits = open; bits; bits &= bits - 1) {
          const int x = 64 * w + std::countr_zero(bits);
          word(x, y, z) &= ~(std::uint64_t{1} << ((x + kMargin) % 64));
        }
      }
  }
}

std::uint64_t& Occupancy::word(int x, int y, int z) {
  return bits_[size(z + kMargin) * slice_ + size((x + kMargin) / 64) * column_ + size(y + kMargin)];
}

bool Occupancy::taken(const Cell& c) const {
  for (std::size_t d = 0; d < 3; ++d)
    if (c[d] < 0 || c[d] >= frame_.size[d]) return true;
  return (const_cast<Occupancy*>(this)->word(c[0], c[1], c[2]) >> ((c[0] + kMargin) % 64)) & 1U;
}

std::uint64_t Occupancy::taken_from(int x, int y, int z) const {
  y += kMargin, z += kMargin, x += kMargin;
  const int words = static_cast<int>(slice_ / column_);
  if (y < 0 || y >= frame_.size[1] + 2 * kMargin || z < 0 || z >= frame_.size[2] + 2 * kMargin)
    return ~std::uint64_t{0};
  const std::uint64_t* row = bits_.data() + size(z) * slice_ + size(y);
  return bits_from(x,
                   [&](int w) { return w < 0 || w >= words ? ~std::uint64_t{0} : row[size(w) * column_]; });
}

bool Occupancy::inside(const Stamp& stamp, const Cell& at) const {
  for (std::size_t d = 0; d < 3; ++d) {
    const int low = at[d] + stamp.low[d];
    if (low < -kMargin || low + stamp.size[d] > frame_.size[d] + kMargin) return false;
  }
  return true;
}

Window Occupancy::window(const Stamp& stamp, const Cell& at) const {
  return window_of(stamp, const_cast<std::uint64_t*>(bits_.data()), column_, slice_,
                   at[0] + stamp.low[0] + kMargin, at[1] + stamp.low[1] + kMargin,
                   at[2] + stamp.low[2] + kMargin);
}

void Occupancy::copy(const Cell& low, int slices, int words, int rows, std::uint64_t* out, std::size_t column,
                     std::size_t slice) const {
  const int x = low[0] + kMargin, y = low[1] + kMargin, z = low[2] + kMargin;
  const int last_word = static_cast<int>(slice_ / column_) - 1, last_slice = frame_.size[2] + 2 * kMargin - 1;
  const int first_word = x >= 0 ? x / 64 : -((63 - x) / 64), shift = x - 64 * first_word;
  // slices, and eights of rows, that the lattice has
  const auto clip = [](int first, int last, int least, int most) {
    return std::pair{std::clamp(least - first, 0, last - first), std::clamp(most - first, 0, last - first)};
  };
  const auto [z_begin, z_end] = clip(z, z + slices, 0, last_slice + 1);
  const int y_begin = std::min(rows, std::max(0, (-y + 7) / 8 * 8)),
            y_end = std::clamp((static_cast<int>(column_) - y) / 8 * 8, y_begin, rows);
  for (int w = 0; w < words; ++w) {
    const int word = first_word + w;
    const bool there = word >= 0 && word < last_word;
    std::uint64_t* to = out + size(w) * column;
    const bool near = word >= -1 && word <= last_word;  // its bits may reach into the lattice
    const auto wall = [&](int k_begin, int k_end, int j_begin, int j_end) {
      for (int k = k_begin; k < k_end; ++k)
        for (int j = j_begin; j < j_end; ++j)
          to[size(k) * slice + size(j)] =
              near && y + j >= 0 && k >= z_begin && k < z_end && y + j < static_cast<int>(column_)
                  ? taken_from(low[0] + 64 * w, low[1] + j, low[2] + k)
                  : ~std::uint64_t{0};
    };
    if (!there || z_begin >= z_end || y_begin >= y_end) {
      wall(0, slices, 0, rows);
      continue;
    }
    wall(0, z_begin, 0, rows);
    wall(z_end, slices, 0, rows);
    wall(z_begin, z_end, 0, y_begin);
    wall(z_begin, z_end, y_end, rows);
    std::uint64_t* from = const_cast<std::uint64_t*>(bits_.data());
    window_copy(
        {from + size(z + z_begin) * slice_ + size(word) * column_ + size(y + y_begin), column_, slice_},
        shift, z_end - z_begin, y_end - y_begin, {to + size(z_begin) * slice + size(y_begin), column, slice});
  }
}

bool Occupancy::hits(const Stamp& stamp, const Cell& at) const {
  return !inside(stamp, at) || window_hits(window(stamp, at));
}

bool Occupancy::hits_on_move(const Stamp& stamp, const Cell& at, int axis, int sign) const {
  Cell to = at;
  to[size(axis)] += sign;
  if (!inside(stamp, to)) return true;
  return window_hits_ahead(window(stamp, at), axis, sign);
}

std::int64_t Occupancy::shared(const Stamp& stamp, const Cell& at) const {
  return inside(stamp, at) ? window_count(window(stamp, at)) : 1;
}

void Occupancy::flip(const Stamp& stamp, const Cell& at) {
  window_flip(window(stamp, at));
}

void Occupancy::move(const Stamp& stamp, Cell& at, int axis, int sign) {
  if (axis == 0) {
    flip(stamp, at);
    at[0] += sign;
    flip(stamp, at);
    return;
  }
  window_move(window(stamp, at), axis, sign);
  at[size(axis)] += sign;
}

void Occupancy::write(const Stamp& stamp, const Cell& at) {
  window_write(window(stamp, at));
}

std::int64_t Occupancy::count_open() const {
  std::int64_t open = 0;
  for (const std::uint64_t word : bits_) open += std::popcount(~word);
  return open;
}

}  // namespace packbed
