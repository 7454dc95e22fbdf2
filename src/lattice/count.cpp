#include "lattice/count.hpp"

#include <algorithm>
#include <bit>

#include "math/simd.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

PACKBED_WIDE std::int64_t count_both(const std::uint64_t* a, const std::uint64_t* b, std::size_t n) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += std::popcount(a[i] & b[i]);
  return sum;
}

std::size_t words_per_slice(const VoxelGrid& grid) {
  return grid.frame.words_per_row() * static_cast<std::size_t>(grid.frame.size[1]);
}

const std::uint64_t* slice(const VoxelGrid& grid, int z) {
  return grid.words.data() + (grid.frame.size[2] == 1 ? 0 : grid.row(0, z));
}

/// Sum and carry of three bits in each of 64 places.
inline __attribute__((always_inline)) void full_add(std::uint64_t& sum, std::uint64_t& carry, std::uint64_t a,
                                                    std::uint64_t b, std::uint64_t c) {
  const std::uint64_t u = a ^ b;
  carry = (a & b) | (u & c);
  sum = u ^ c;
}

/// Adds eight bits to each place of three-digit counters through a tree of adders; what they overflow by goes
/// to `eight`. v[s] & m[s]: the words of slice s.
PACKBED_WIDE void add_eight(const std::uint64_t* const* v, const std::uint64_t* const* m, std::size_t words,
                            std::uint64_t* p0, std::uint64_t* p1, std::uint64_t* p2, std::uint64_t* eight) {
  for (std::size_t i = 0; i < words; ++i) {
    std::uint64_t one = p0[i], two = p1[i], four = p2[i], a, b, c, d, e, f;
    full_add(one, a, one, v[0][i] & m[0][i], v[1][i] & m[1][i]);
    full_add(one, b, one, v[2][i] & m[2][i], v[3][i] & m[3][i]);
    full_add(one, c, one, v[4][i] & m[4][i], v[5][i] & m[5][i]);
    full_add(one, d, one, v[6][i] & m[6][i], v[7][i] & m[7][i]);
    full_add(two, e, two, a, b);
    full_add(two, f, two, c, d);
    full_add(four, eight[i], four, e, f);
    p0[i] = one;
    p1[i] = two;
    p2[i] = four;
  }
}

PACKBED_WIDE void add_digit(std::uint64_t* plane, std::uint64_t* carry, std::size_t words) {
  for (std::size_t i = 0; i < words; ++i) {
    const std::uint64_t next = plane[i] & carry[i];
    plane[i] ^= carry[i];
    carry[i] = next;
  }
}

/// 64 counters a word, stored as one word for each binary digit ("vertical counters"): digit d of word w is
/// planes[d][w].
class VerticalCounters {
 public:
  VerticalCounters(std::size_t words, int most)
      : planes_(static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(std::max(8, most)))),
                std::vector<std::uint64_t>(words, 0)),
        carry_(words) {}

  void add8(const std::uint64_t* const* v, const std::uint64_t* const* m) {
    add_eight(v, m, carry_.size(), planes_[0].data(), planes_[1].data(), planes_[2].data(), carry_.data());
    for (std::size_t d = 3; d < planes_.size(); ++d)
      add_digit(planes_[d].data(), carry_.data(), carry_.size());
  }
  void add(const std::uint64_t* v, const std::uint64_t* m) {
    for (std::size_t i = 0; i < carry_.size(); ++i) carry_[i] = v[i] & m[i];
    for (std::vector<std::uint64_t>& plane : planes_) add_digit(plane.data(), carry_.data(), carry_.size());
  }

  std::int32_t count(std::size_t word, int bit) const {
    std::int32_t n = 0;
    for (std::size_t d = 0; d < planes_.size(); ++d)
      n |= static_cast<std::int32_t>((planes_[d][word] >> bit) & 1U) << d;
    return n;
  }

 private:
  std::vector<std::vector<std::uint64_t>> planes_;
  std::vector<std::uint64_t> carry_;
};

}  // namespace

std::vector<std::int64_t> slice_counts(const VoxelGrid& grid, const VoxelGrid& space) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(grid.frame.size[2]), 0);
  const std::size_t words = words_per_slice(grid);
  parallel_for(counts.size(), 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t z = begin; z < end; ++z)
      counts[z] = count_both(slice(grid, static_cast<int>(z)), slice(space, static_cast<int>(z)), words);
  });
  return counts;
}

std::vector<std::int64_t> slice_counts(const VoxelGrid& grid) {
  return slice_counts(grid, grid);
}

std::vector<std::int32_t> column_counts(const VoxelGrid& grid, const VoxelGrid& space, int z_begin,
                                        int z_end) {
  const std::size_t nx = static_cast<std::size_t>(grid.frame.size[0]),
                    ny = static_cast<std::size_t>(grid.frame.size[1]);
  const std::size_t row = grid.frame.words_per_row();
  std::vector<std::int32_t> columns(nx * ny, 0);
  parallel_for(ny, 8, [&](std::size_t y_begin, std::size_t y_end) {
    constexpr std::size_t kRows = 32;  // the counters of so many rows stay in the first cache
    for (std::size_t y = y_begin; y < y_end; y += kRows) {
      const std::size_t rows = std::min(kRows, y_end - y), words = rows * row;
      VerticalCounters counters(words, z_end - z_begin);
      int z = z_begin;
      for (; z + 8 <= z_end; z += 8) {
        std::array<const std::uint64_t*, 8> v, m;
        for (int s = 0; s < 8; ++s) {
          v[static_cast<std::size_t>(s)] = slice(grid, z + s) + y * row;
          m[static_cast<std::size_t>(s)] = slice(space, z + s) + y * row;
        }
        counters.add8(v.data(), m.data());
      }
      for (; z < z_end; ++z) counters.add(slice(grid, z) + y * row, slice(space, z) + y * row);
      for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t x = 0; x < nx; ++x)
          columns[(y + r) * nx + x] = counters.count(r * row + x / 64, static_cast<int>(x % 64));
    }
  });
  return columns;
}

}  // namespace packbed
