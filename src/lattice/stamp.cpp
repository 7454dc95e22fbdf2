#include "lattice/stamp.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

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

struct Extent {
  int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();
  void add(int v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  int size() const { return high - low + 1; }
};

/// Word `w` of a row that starts at bit `first` of the block's row.
std::uint64_t word_at(const std::uint64_t* row, int words, int first, int w) {
  const int bit = first + 64 * w;  // >= -1: the border reaches one bit before the row
  const auto at = [&](int i) { return i >= 0 && i < words ? row[i] : 0; };
  const int word = bit >= 0 ? bit / 64 : -1, shift = bit - 64 * word;
  return (at(word) >> shift) | ((at(word + 1) << 1) << (63 - shift));
}

Stamp stamp_of(const BitBlock& block, int middle) {
  Extent x, y, z;
  for (int k = 0; k < block.nz; ++k)
    for (int j = 0; j < block.ny; ++j)
      for (int w = 0; w < block.words; ++w) {
        const std::uint64_t bits = block.row(j, k)[w];
        if (!bits) continue;
        x.add(64 * w + std::countr_zero(bits));
        x.add(64 * w + 63 - std::countl_zero(bits));
        y.add(j);
        z.add(k);
      }
  Stamp stamp;
  if (x.low > x.high) return stamp;
  stamp.size = {x.size() + 2, y.size() + 2, z.size() + 2};
  stamp.low = {64 * block.word + x.low - 1 - middle, block.y + y.low - 1 - middle,
               block.z + z.low - 1 - middle};
  stamp.words = (stamp.size[0] + 63) / 64;
  stamp.rows = (stamp.size[1] + 7) / 8 * 8;
  stamp.bits.assign(2 * Stamp::kPad + static_cast<std::size_t>(stamp.size[2]) * stamp.slice(), 0);
  for (int k = 0; k < z.size(); ++k)
    for (int w = 0; w < stamp.words; ++w) {
      std::uint64_t* to = stamp.data() + static_cast<std::size_t>(k + 1) * stamp.slice() +
                          static_cast<std::size_t>(w) * stamp.column() + 1;
      for (int j = 0; j < y.size(); ++j) {
        to[j] = word_at(block.row(y.low + j, z.low + k), block.words, x.low - 1, w);
        stamp.count += std::popcount(to[j]);
      }
    }
  return stamp;
}

}  // namespace

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
