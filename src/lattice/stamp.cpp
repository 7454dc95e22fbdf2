#include "lattice/stamp.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "math/simd.hpp"

namespace packbed {
namespace {

/// How far the number of cells may be off before another phase is tried: digitising 10,000 cells scatters by
/// 0.15 %, so that most rotations need one try. A body along the lattice's axes, whose faces cross whole
/// layers of cells at once, may need many.
constexpr double kVolumeTolerance = 2.5e-3;
constexpr int kTries = 40, kNearTries = 8;

/// Evenly spread phases (Roberts' R3 sequence, 2018: powers of the root of x^4 = x + 1), within a quarter of
/// a cell at first and within half a cell where these do not do.
Vec3 phase_of(int k) {
  constexpr double kRoot = 1.2207440846057596;
  const double reach = k < kNearTries ? 0.25 : 0.5;
  Vec3 phase;
  double power = 1;
  for (int d = 0; d < 3; ++d) {
    power /= kRoot;
    const double u = 0.5 + (k + 1) * power;
    phase[d] = reach * (2 * (u - std::floor(u)) - 1);
  }
  return phase;
}

GridFrame frame_round(double pitch, double largest) {
  GridFrame frame;
  frame.pitch = pitch;
  const int half = static_cast<int>(std::ceil(largest / pitch)) + 3;
  frame.size = {2 * half + 1, 2 * half + 1, 2 * half + 1};
  return frame;
}

/// First and last place where something is set.
struct Extent {
  int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();
  void add(int v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  int size() const { return high - low + 1; }
};

/// Ors the rows of one slice (n words) into `all` and returns the or of them all.
PACKBED_WIDE std::uint64_t gather_rows(const std::uint64_t* rows, int n, std::uint64_t* all) {
  std::uint64_t any = 0;
  for (int j = 0; j < n; ++j) {
    all[j] |= rows[j];
    any |= rows[j];
  }
  return any;
}

/// Rows of one word each, moved down by `right` bits, or up by one for -1.
PACKBED_WIDE void move_rows(const std::uint64_t* from, int n, int right, std::uint64_t* to) {
  if (right < 0)
    for (int j = 0; j < n; ++j) to[j] = from[j] << 1;
  else
    for (int j = 0; j < n; ++j) to[j] = from[j] >> right;
}

PACKBED_WIDE std::int64_t count_bits(const std::uint64_t* words, std::size_t n) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < n; ++i) count += std::popcount(words[i]);
  return count;
}

/// Word `w` of a row that starts at bit `first` of the block's row.
std::uint64_t word_at(const std::uint64_t* row, int words, int first, int w) {
  const int bit = first + 64 * w;  // >= -1: the border reaches one bit before the row
  const auto at = [&](int i) { return i >= 0 && i < words ? row[i] : 0; };
  const int word = bit >= 0 ? bit / 64 : -1, shift = bit - 64 * word;
  return (at(word) >> shift) | ((at(word + 1) << 1) << (63 - shift));
}

struct Box {
  Extent x, y, z;
};

/// Where a block has bits.
Box box_of(const BitBlock& block) {
  const int row_words = block.ny * block.words;
  std::vector<std::uint64_t> all(static_cast<std::size_t>(row_words), 0);  // of all slices
  Box box;
  for (int k = 0; k < block.nz; ++k)
    if (gather_rows(block.row(0, k), row_words, all.data())) box.z.add(k);
  for (int j = 0; j < block.ny; ++j)
    for (int w = 0; w < block.words; ++w) {
      const std::uint64_t bits = all[static_cast<std::size_t>(j * block.words + w)];
      if (!bits) continue;
      box.y.add(j);
      box.x.add(64 * w + std::countr_zero(bits));
      box.x.add(64 * w + 63 - std::countl_zero(bits));
    }
  return box;
}

}  // namespace

Stamp stamp_of(const BitBlock& block, int middle) {
  const Box box = box_of(block);
  Stamp stamp;
  if (box.x.low > box.x.high) return stamp;
  stamp.size = {box.x.size() + 2, box.y.size() + 2, box.z.size() + 2};
  stamp.low = {64 * block.word + box.x.low - 1 - middle, block.y + box.y.low - 1 - middle,
               block.z + box.z.low - 1 - middle};
  stamp.words = (stamp.size[0] + 63) / 64;
  stamp.rows = (stamp.size[1] + 7) / 8 * 8;
  stamp.bits.assign(2 * Stamp::kPad + static_cast<std::size_t>(stamp.size[2]) * stamp.slice(), 0);
  for (int k = 0; k < box.z.size(); ++k)
    for (int w = 0; w < stamp.words; ++w) {
      std::uint64_t* to = stamp.data() + static_cast<std::size_t>(k + 1) * stamp.slice() +
                          static_cast<std::size_t>(w) * stamp.column() + 1;
      const std::uint64_t* from = block.row(box.y.low, box.z.low + k);
      if (block.words == 1 && stamp.words == 1)
        move_rows(from, box.y.size(), box.x.low - 1, to);
      else
        for (int j = 0; j < box.y.size(); ++j, from += block.words)
          to[j] = word_at(from, block.words, box.x.low - 1, w);
    }
  stamp.count = block.count >= 0 ? block.count : count_bits(stamp.bits.data(), stamp.bits.size());
  return stamp;
}

StampMaker::StampMaker(double pitch, double largest)
    : frame_(frame_round(pitch, largest)), middle_(frame_.size[0] / 2), rasteriser_(frame_) {}

Stamp StampMaker::make(const Shape& shape, double scale, const Quat& rotation, const Vec3& phase) {
  const Vec3 centre = frame_.pitch * (phase.array() + (middle_ + 0.5)).matrix();
  return stamp_of(rasteriser_.body(shape, {centre, rotation}, scale, 0, frame_.size[2]), middle_);
}

Stamp StampMaker::make_true(const Shape& shape, double scale, const Quat& rotation, Vec3& phase) {
  const double wanted = shape.volume * std::pow(scale / frame_.pitch, 3);
  Stamp best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kTries; ++k) {
    const Vec3 tried = phase_of(k);
    Stamp stamp = make(shape, scale, rotation, tried);
    const double off = std::abs(static_cast<double>(stamp.count) / wanted - 1);
    if (off < least) {
      least = off;
      best = std::move(stamp);
      phase = tried;
    }
    if (least <= kVolumeTolerance) break;
  }
  return best;
}

}  // namespace packbed
