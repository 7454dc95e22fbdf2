#include "lattice/window.hpp"

#include <bit>

#include "math/simd.hpp"

namespace packbed {
namespace {

constexpr int kLane = 8;  // rows at a time
constexpr int kAsk = 3;   // bits of z: adding up the lanes costs as much as a slice, so every fourth one asks

inline bool any_of(const std::uint64_t* found) {
  std::uint64_t any = 0;
  for (int k = 0; k < kLane; ++k) any |= found[k];
  return any != 0;
}

inline std::uint64_t seen(const std::uint64_t* low, const std::uint64_t* high, int shift) {
  return (*low >> shift) | ((*high << 1) << (63 - shift));
}

}  // namespace

PACKBED_WIDE bool window_hits(const Window& w) {
  std::uint64_t found[kLane] = {};
  for (int z = 0; z < w.slices; ++z) {
    for (int x = 0; x < w.words; ++x) {
      const std::uint64_t* low = w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
                                 static_cast<std::size_t>(x) * w.lattice_column;
      const std::uint64_t* high = low + w.lattice_column;
      const std::uint64_t* t = w.stamp + static_cast<std::size_t>(z) * w.stamp_slice +
                               static_cast<std::size_t>(x) * w.stamp_column;
      for (int y = 0; y < w.rows; y += kLane)
        for (int k = 0; k < kLane; ++k) found[k] |= seen(low + y + k, high + y + k, w.shift) & t[y + k];
    }
    if ((z & kAsk) == 0 && any_of(found)) return true;
  }
  return any_of(found);
}

PACKBED_WIDE bool window_hits_ahead(const Window& w, std::ptrdiff_t step) {
  std::uint64_t found[kLane] = {};
  for (int z = 0; z < w.slices; ++z) {
    for (int x = 0; x < w.words; ++x) {
      const std::uint64_t* low = w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
                                 static_cast<std::size_t>(x) * w.lattice_column;
      const std::uint64_t* high = low + w.lattice_column;
      const std::uint64_t* t = w.stamp + static_cast<std::size_t>(z) * w.stamp_slice +
                               static_cast<std::size_t>(x) * w.stamp_column;
      const std::uint64_t* ahead = t - step;
      for (int y = 0; y < w.rows; y += kLane)
        for (int k = 0; k < kLane; ++k)
          found[k] |= seen(low + y + k, high + y + k, w.shift) & ahead[y + k] & ~t[y + k];
    }
    if ((z & kAsk) == 0 && any_of(found)) return true;
  }
  return any_of(found);
}

PACKBED_WIDE bool window_hits_ahead_x(const Window& w, bool up) {
  const int out = up ? 1 : 0, in = up ? 0 : 1;  // one of them moves, the other stays
  std::uint64_t found[kLane] = {};
  for (int z = 0; z < w.slices; ++z) {
    for (int x = 0; x < w.words; ++x) {
      const std::uint64_t* low = w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
                                 static_cast<std::size_t>(x) * w.lattice_column;
      const std::uint64_t* high = low + w.lattice_column;
      const std::uint64_t* t = w.stamp + static_cast<std::size_t>(z) * w.stamp_slice +
                               static_cast<std::size_t>(x) * w.stamp_column;
      // what comes over from the neighbouring word; at the ends there is none, the border is empty
      const bool edge = up ? x == 0 : x + 1 == w.words;
      const std::uint64_t* side = up ? t - w.stamp_column : t + w.stamp_column;
      if (edge) side = t;
      const std::uint64_t keep = edge ? 0 : ~std::uint64_t{0};
      const int carry = 63;
      for (int y = 0; y < w.rows; y += kLane)
        for (int k = 0; k < kLane; ++k) {
          const std::uint64_t over = up ? side[y + k] >> carry : side[y + k] << carry;
          const std::uint64_t ahead = ((t[y + k] << out) >> in) | (over & keep);
          found[k] |= seen(low + y + k, high + y + k, w.shift) & ahead & ~t[y + k];
        }
    }
    if ((z & kAsk) == 0 && any_of(found)) return true;
  }
  return any_of(found);
}

PACKBED_WIDE bool window_column_ahead(const Window& w, int x, int z, int axis, int sign,
                                      std::uint64_t* found) {
  if (axis == 2 && (sign > 0 ? z == 0 : z + 1 == w.slices)) return false;  // nothing behind the border
  const std::uint64_t* low = w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
                             static_cast<std::size_t>(x) * w.lattice_column;
  const std::uint64_t* high = low + w.lattice_column;
  const std::uint64_t* t =
      w.stamp + static_cast<std::size_t>(z) * w.stamp_slice + static_cast<std::size_t>(x) * w.stamp_column;
  std::uint64_t any = 0;
  if (axis == 0) {
    const bool up = sign > 0, edge = up ? x == 0 : x + 1 == w.words;
    const std::uint64_t* side = edge ? t : up ? t - w.stamp_column : t + w.stamp_column;
    const std::uint64_t keep = edge ? 0 : ~std::uint64_t{0};
    for (int y = 0; y < w.rows; ++y) {
      const std::uint64_t over = (up ? side[y] >> 63 : side[y] << 63) & keep;
      found[y] = seen(low + y, high + y, w.shift) & ((up ? t[y] << 1 : t[y] >> 1) | over) & ~t[y];
      any |= found[y];
    }
  } else {
    const std::uint64_t* ahead = t - (axis == 1 ? sign : sign * static_cast<std::ptrdiff_t>(w.stamp_slice));
    for (int y = 0; y < w.rows; ++y) {
      found[y] = seen(low + y, high + y, w.shift) & ahead[y] & ~t[y];
      any |= found[y];
    }
  }
  return any != 0;
}

std::int64_t window_count(const Window& w) {
  std::int64_t count = 0;
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x) {
      const std::uint64_t* low = w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
                                 static_cast<std::size_t>(x) * w.lattice_column;
      const std::uint64_t* t = w.stamp + static_cast<std::size_t>(z) * w.stamp_slice +
                               static_cast<std::size_t>(x) * w.stamp_column;
      for (int y = 0; y < w.rows; ++y)
        count += std::popcount(seen(low + y, low + w.lattice_column + y, w.shift) & t[y]);
    }
  return count;
}

PACKBED_WIDE void window_flip(const Window& w) {
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x) {
      std::uint64_t* low = w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
                           static_cast<std::size_t>(x) * w.lattice_column;
      std::uint64_t* high = low + w.lattice_column;
      const std::uint64_t* t = w.stamp + static_cast<std::size_t>(z) * w.stamp_slice +
                               static_cast<std::size_t>(x) * w.stamp_column;
      for (int y = 0; y < w.rows; ++y) low[y] ^= t[y] << w.shift;
      if (w.shift == 0) continue;
      for (int y = 0; y < w.rows; ++y) high[y] ^= (t[y] >> 1) >> (63 - w.shift);
    }
}

PACKBED_WIDE void window_move(const Window& w, std::ptrdiff_t step) {
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x) {
      std::uint64_t* low = w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
                           static_cast<std::size_t>(x) * w.lattice_column;
      std::uint64_t* high = low + w.lattice_column;
      const std::uint64_t* t = w.stamp + static_cast<std::size_t>(z) * w.stamp_slice +
                               static_cast<std::size_t>(x) * w.stamp_column;
      const std::uint64_t* ahead = t - step;
      for (int y = 0; y < w.rows; ++y) low[y] ^= (t[y] ^ ahead[y]) << w.shift;
      if (w.shift == 0) continue;
      for (int y = 0; y < w.rows; ++y) high[y] ^= ((t[y] ^ ahead[y]) >> 1) >> (63 - w.shift);
    }
}

PACKBED_WIDE void window_write(const Window& w) {
  for (int z = 0; z < w.slices; ++z)
    for (int x = 0; x < w.words; ++x) {
      std::uint64_t* low = w.lattice + static_cast<std::size_t>(z) * w.lattice_slice +
                           static_cast<std::size_t>(x) * w.lattice_column;
      std::uint64_t* high = low + w.lattice_column;
      const std::uint64_t* t = w.stamp + static_cast<std::size_t>(z) * w.stamp_slice +
                               static_cast<std::size_t>(x) * w.stamp_column;
      for (int y = 0; y < w.rows; ++y) low[y] |= t[y] << w.shift;
      if (w.shift == 0) continue;
      for (int y = 0; y < w.rows; ++y) high[y] |= (t[y] >> 1) >> (63 - w.shift);
    }
}

}  // namespace packbed
