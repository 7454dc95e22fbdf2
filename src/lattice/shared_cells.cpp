#include "lattice/shared_cells.hpp"

#include <algorithm>
#include <bit>

namespace packbed {
namespace {

/// Bits of a stamp from bit x of row (y, z) of its box; empty outside.
struct StampBits {
  const Stamp* stamp;
  std::uint64_t operator()(int x, int y, int z) const {
    const Stamp& s = *stamp;
    if (y < 0 || z < 0 || y >= s.size[1] || z >= s.size[2]) return 0;
    const int word = x >= 0 ? x / 64 : -((63 - x) / 64), shift = x - 64 * word;
    const std::uint64_t* row =
        s.data() + static_cast<std::size_t>(z) * s.slice() + static_cast<std::size_t>(y);
    const auto at = [&](int w) {
      return w < 0 || w >= s.words ? std::uint64_t{0} : row[static_cast<std::size_t>(w) * s.column()];
    };
    return (at(word) >> shift) | ((at(word + 1) << 1) << (63 - shift));
  }
};

/// Adds one word of shared cells; a and b give bits of either body round it, (x, y, z) counted from a's box.
template <class A, class B>
void add_word(std::uint64_t both, int x, int y, int z, const Cell& low, const A& a, const B& b,
              SharedCells& s) {
  static constexpr std::uint64_t kDigit[6] = {0xaaaaaaaaaaaaaaaa, 0xcccccccccccccccc, 0xf0f0f0f0f0f0f0f0,
                                              0xff00ff00ff00ff00, 0xffff0000ffff0000, 0xffffffff00000000};
  const std::int64_t n = std::popcount(both);
  std::int64_t within = 0;  // sum of the bits' numbers, digit by digit
  for (int d = 0; d < 6; ++d) within += static_cast<std::int64_t>(std::popcount(both & kDigit[d])) << d;
  s.count += n;
  s.sum[0] += within + n * (low[0] + x);
  s.sum[1] += n * (low[1] + y);
  s.sum[2] += n * (low[2] + z);
  // a face of b looks along +x where its neighbour there is not b's; likewise for a, with the other sign
  const auto faces = [&](int dx, int dy, int dz) {
    return static_cast<std::int64_t>(std::popcount(both & ~b(x + dx, y + dy, z + dz))) -
           static_cast<std::int64_t>(std::popcount(both & ~a(x + dx, y + dy, z + dz)));
  };
  s.area[0] += faces(1, 0, 0) - faces(-1, 0, 0);
  s.area[1] += faces(0, 1, 0) - faces(0, -1, 0);
  s.area[2] += faces(0, 0, 1) - faces(0, 0, -1);
}

}  // namespace

SharedCells shared_cells(const Stamp& a, const Stamp& b, const Cell& apart) {
  SharedCells s;
  Cell shift{};  // b's box as a's box counts
  int low[3], high[3];
  for (std::size_t d = 0; d < 3; ++d) {
    shift[d] = apart[d] + b.low[d] - a.low[d];
    low[d] = std::max(1, shift[d] + 1);  // the borders are empty
    high[d] = std::min(a.size[d], shift[d] + b.size[d]) - 1;
    if (low[d] >= high[d]) return s;
  }
  const StampBits bits_a{&a}, own_b{&b};
  const auto bits_b = [&](int x, int y, int z) { return own_b(x - shift[0], y - shift[1], z - shift[2]); };
  for (int z = low[2]; z < high[2]; ++z)
    for (int w = 0; w < a.words; ++w) {
      const std::uint64_t* row =
          a.data() + static_cast<std::size_t>(z) * a.slice() + static_cast<std::size_t>(w) * a.column();
      for (int y = low[1]; y < high[1]; ++y) {
        if (!row[y]) continue;
        if (const std::uint64_t both = row[y] & bits_b(64 * w, y, z))
          add_word(both, 64 * w, y, z, a.low, bits_a, bits_b, s);
      }
    }
  return s;
}

SharedCells shared_cells(const Stamp& a, const Occupancy& lattice, const Cell& at, int z_begin, int z_end) {
  SharedCells s;
  const StampBits bits_a{&a};
  const Cell base{at[0] + a.low[0], at[1] + a.low[1], at[2] + a.low[2]};
  const auto bits_b = [&](int x, int y, int z) {
    return lattice.taken_from(base[0] + x, base[1] + y, base[2] + z);
  };
  const int low = std::max(1, z_begin - base[2]), high = std::min(a.size[2] - 1, z_end - base[2]);
  for (int z = low; z < high; ++z)
    for (int w = 0; w < a.words; ++w) {
      const std::uint64_t* row =
          a.data() + static_cast<std::size_t>(z) * a.slice() + static_cast<std::size_t>(w) * a.column();
      for (int y = 1; y < a.size[1] - 1; ++y) {
        if (!row[y]) continue;
        if (const std::uint64_t both = row[y] & bits_b(64 * w, y, z))
          add_word(both, 64 * w, y, z, a.low, bits_a, bits_b, s);
      }
    }
  return s;
}

}  // namespace packbed
