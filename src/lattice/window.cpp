#include "lattice/window.hpp"

#include <algorithm>
#include <bit>

#include "lattice/words8.hpp"
#include "math/simd.hpp"

namespace packbed {
namespace {

constexpr int kLane = kWords8;  // rows at a time
constexpr int kAsk = 3;         // bits of z: asking costs as much as a slice, so every fourth one does

/// Where one word of one slice begins, on the lattice and in the stamp.
struct Column {
  Column(const Window& w, int x, int z)
      : low(w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
            static_cast<std::size_t>(x) * w.lattice_column),
        high(low + w.lattice_column),
        stamp(w.stamp + static_cast<std::size_t>(z) * w.stamp_slice +
              static_cast<std::size_t>(x) * w.stamp_column) {}
  std::uint64_t *low, *high;  // the stamp's bits lie in two words of the lattice
  const std::uint64_t* stamp;
};

/// What is set in the lattice where bits of the stamp lie, eight rows from y.
inline void seen(const Window& w, const Column& c, int y, Words8& out) {
  load(c.low + y, out);
  out >>= w.shift;
  if (w.narrow) return;
  Words8 high;
  load(c.high + y, high);
  out |= (high << 1) << (63 - w.shift);
}

/// Of these, the stamp's.
inline void shared(const Window& w, const Column& c, int y, Words8& out) {
  Words8 stamp;
  load(c.stamp + y, stamp);
  seen(w, c, y, out);
  out &= stamp;
}

/// Stamp moved by one cell, without the stamp, eight rows from y of one column.
class Ahead {
 public:
  Ahead(const Window& w, const Column& c, int x, int axis, int sign) : stamp_(c.stamp), up_(sign > 0) {
    along_x_ = axis == 0;
    if (along_x_) {
      // what comes over from the neighbouring word; at the ends there is none
      edge_ = up_ ? x == 0 : x + 1 == w.words;
      moved_ = edge_ ? stamp_ : up_ ? stamp_ - w.stamp_column : stamp_ + w.stamp_column;
    } else {
      moved_ = stamp_ - (axis == 1 ? sign : sign * static_cast<std::ptrdiff_t>(w.stamp_slice));
    }
  }
  void at(int y, Words8& out) const {
    Words8 here, moved;
    load(stamp_ + y, here);
    load(moved_ + y, moved);
    if (along_x_) {
      const Words8 over = up_ ? moved >> 63 : moved << 63;
      moved = up_ ? here << 1 : here >> 1;
      if (!edge_) moved |= over;
    }
    out = moved & ~here;
  }

 private:
  const std::uint64_t *stamp_, *moved_ = nullptr;
  bool up_, along_x_ = false, edge_ = false;
};

/// Slices that a move may enter: along z the one that has none behind it is border, and enters nothing.
struct Slices {
  Slices(const Window& w, int axis, int sign)
      : first(axis == 2 && sign > 0 ? 1 : 0),
        last(axis == 2 && sign < 0 ? w.slices - 1 : w.slices),
        ranges(axis == 2 ? w.ranges - sign : w.ranges) {}
  int first, last;
  const RowRange* ranges;  // what enters a slice comes from these rows
};

/// All rows of both ranges, of a box of so many rows.
inline RowRange join(const RowRange& a, const RowRange& b, int rows) {
  if (a.eights == 0 || b.eights == 0) return a.eights == 0 ? b : a;
  const int first = std::min(a.first, b.first), eights = (std::max(a.end(), b.end()) - first + 7) / 8;
  return {static_cast<std::uint16_t>(std::min(first, rows - 8 * eights)), static_cast<std::uint16_t>(eights)};
}

/// Appends those of eight rows that have cells.
inline std::size_t append(const Words8& found, int x, int y, int z, HitRow* out) {
  std::size_t n = 0;
  for (int k = 0; k < kLane; ++k)
    if (found[k]) out[n++] = {found[k], x, y + k, z};
  return n;
}

}  // namespace

PACKBED_WIDE bool window_hits(const Window& w) {
  Words8 found{};
  for (int z = 0; z < w.slices; ++z) {
    for (int x = 0; x < w.words; ++x) {
      const Column c(w, x, z);
      for (int y = w.ranges[z].first; y < w.ranges[z].end(); y += kLane) {
        Words8 both;
        shared(w, c, y, both);
        found |= both;
      }
    }
    if ((z & kAsk) == 0 && any_of(found)) return true;
  }
  return any_of(found);
}

PACKBED_WIDE bool window_hits_ahead(const Window& w, int axis, int sign) {
  Words8 found{};
  const Slices slices(w, axis, sign);
  for (int z = slices.first; z < slices.last; ++z) {
    for (int x = 0; x < w.words; ++x) {
      const Column c(w, x, z);
      const Ahead ahead(w, c, x, axis, sign);
      for (int y = slices.ranges[z].first; y < slices.ranges[z].end(); y += kLane) {
        Words8 taken, entered;
        seen(w, c, y, taken);
        ahead.at(y, entered);
        found |= taken & entered;
      }
    }
    if ((z & kAsk) == 0 && any_of(found)) return true;
  }
  return any_of(found);
}

PACKBED_WIDE std::size_t window_list(const Window& w, HitRow* out) {
  std::size_t n = 0;
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x) {
      const Column c(w, x, z);
      for (int y = w.ranges[z].first; y < w.ranges[z].end(); y += kLane) {
        Words8 both;
        shared(w, c, y, both);
        if (any_of(both)) n += append(both, x, y, z, out + n);
      }
    }
  return n;
}

PACKBED_WIDE void window_copy(const Columns& from, int shift, int slices, int rows, const Columns& to) {
  for (int z = 0; z < slices; ++z) {
    const std::uint64_t *low = from.first + static_cast<std::size_t>(z) * from.slice,
                        *high = low + from.column;
    std::uint64_t* out = to.first + static_cast<std::size_t>(z) * to.slice;
    for (int y = 0; y < rows; y += kLane) {
      Words8 here, next;
      load(low + y, here);
      load(high + y, next);
      store((here >> shift) | ((next << 1) << (63 - shift)), out + y);
    }
  }
}

std::int64_t window_count(const Window& w) {
  std::int64_t count = 0;
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x) {
      const Column c(w, x, z);
      for (int y = w.ranges[z].first; y < w.ranges[z].end(); y += kLane) {
        Words8 both;
        shared(w, c, y, both);
        for (int k = 0; k < kLane; ++k) count += std::popcount(both[k]);
      }
    }
  return count;
}

namespace {

/// Exclusive-or of eight rows of bits, moved by the window's shift, into the lattice.
inline void toggle(const Window& w, const Column& c, int y, const Words8& bits) {
  Words8 low, high;
  load(c.low + y, low);
  low ^= bits << w.shift;
  store(low, c.low + y);
  if (w.narrow) return;
  load(c.high + y, high);
  high ^= (bits >> 1) >> (63 - w.shift);
  store(high, c.high + y);
}

}  // namespace

PACKBED_WIDE void window_flip(const Window& w) {
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x) {
      const Column c(w, x, z);
      for (int y = w.ranges[z].first; y < w.ranges[z].end(); y += kLane) {
        Words8 stamp;
        load(c.stamp + y, stamp);
        toggle(w, c, y, stamp);
      }
    }
}

PACKBED_WIDE void window_move(const Window& w, int axis, int sign) {
  const Slices slices(w, axis, sign);
  const std::ptrdiff_t step = axis == 1 ? sign : sign * static_cast<std::ptrdiff_t>(w.stamp_slice);
  for (int z = slices.first; z < slices.last; ++z) {
    const RowRange range = join(w.ranges[z], slices.ranges[z], static_cast<int>(w.stamp_column));
    for (int x = 0; x < w.words; ++x) {
      const Column c(w, x, z);
      for (int y = range.first; y < range.end(); y += kLane) {
        Words8 stamp, moved;
        load(c.stamp + y, stamp);
        load(c.stamp - step + y, moved);
        toggle(w, c, y, stamp ^ moved);
      }
    }
  }
}

PACKBED_WIDE void window_write(const Window& w) {
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x) {
      const Column c(w, x, z);
      for (int y = w.ranges[z].first; y < w.ranges[z].end(); y += kLane) {
        Words8 stamp, low, high;
        load(c.stamp + y, stamp);
        load(c.low + y, low);
        store(low | (stamp << w.shift), c.low + y);
        if (w.narrow) continue;
        load(c.high + y, high);
        store(high | ((stamp >> 1) >> (63 - w.shift)), c.high + y);
      }
    }
}

}  // namespace packbed
