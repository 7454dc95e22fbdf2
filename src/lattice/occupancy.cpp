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
  const int word = x >= 0 ? x / 64 : -((63 - x) / 64), shift = x - 64 * word;
  const std::uint64_t* row = bits_.data() + size(z) * slice_ + size(y);
  const auto at = [&](int w) { return w < 0 || w >= words ? ~std::uint64_t{0} : row[size(w) * column_]; };
  return (at(word) >> shift) | ((at(word + 1) << 1) << (63 - shift));
}

bool Occupancy::inside(const Stamp& stamp, const Cell& at) const {
  for (std::size_t d = 0; d < 3; ++d) {
    const int low = at[d] + stamp.low[d];
    if (low < -kMargin || low + stamp.size[d] > frame_.size[d] + kMargin) return false;
  }
  return true;
}

Window Occupancy::window(const Stamp& stamp, const Cell& at) const {
  const int x = at[0] + stamp.low[0] + kMargin, y = at[1] + stamp.low[1] + kMargin,
            z = at[2] + stamp.low[2] + kMargin;
  Window w{};
  w.lattice = const_cast<std::uint64_t*>(bits_.data()) + size(z) * slice_ + size(x / 64) * column_ + size(y);
  w.lattice_column = column_;
  w.lattice_slice = slice_;
  w.shift = x % 64;
  w.stamp = stamp.data();
  w.stamp_column = stamp.column();
  w.stamp_slice = stamp.slice();
  w.slices = stamp.size[2];
  w.words = stamp.words;
  w.rows = stamp.rows;
  return w;
}

bool Occupancy::hits(const Stamp& stamp, const Cell& at) const {
  return !inside(stamp, at) || window_hits(window(stamp, at));
}

bool Occupancy::hits_on_move(const Stamp& stamp, const Cell& at, int axis, int sign) const {
  Cell to = at;
  to[size(axis)] += sign;
  if (!inside(stamp, to)) return true;
  Window w = window(stamp, at);
  if (axis == 0) return window_hits_ahead_x(w, sign > 0);
  if (axis == 1) return window_hits_ahead(w, sign);
  // the slice that has no neighbour behind it is border, and enters nothing
  if (sign > 0) w.lattice += w.lattice_slice, w.stamp += w.stamp_slice;
  --w.slices;
  return window_hits_ahead(w, sign * static_cast<std::ptrdiff_t>(stamp.slice()));
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
  // z: one slice outside of the stamp is read on one side; the pad is too short for it, so the border goes
  // apart
  Window w = window(stamp, at);
  at[size(axis)] += sign;
  if (axis == 1) return window_move(w, sign);
  if (sign > 0) w.lattice += w.lattice_slice, w.stamp += w.stamp_slice;
  --w.slices;
  window_move(w, sign * static_cast<std::ptrdiff_t>(stamp.slice()));
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
