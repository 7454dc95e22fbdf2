#include "lattice/stamp.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "lattice/words8.hpp"
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
  void add(int first, int last) {
    low = std::min(low, first);
    high = std::max(high, last);
  }
  int size() const { return high - low + 1; }
};

/// Where the rows of a slice have cells: first and last row, smallest and largest x, number of cells, by
/// eighths.
struct SliceExtent {
  Numbers8 first, last, low, high, count;
};
PACKBED_WIDE void look_at_slice(const std::int32_t* from, const std::int32_t* to, int n, SliceExtent& seen) {
  const Numbers8 none{}, most = none + std::numeric_limits<std::int32_t>::max(),
                         least = none + std::numeric_limits<std::int32_t>::min();
  Numbers8 low = most, high = least, first = most, last = least, count = none, row = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int j = 0; j < n; j += kWords8, row += kWords8) {
    Numbers8 f, t;
    load(from + j, f);
    load(to + j, t);
    const Numbers8 hit = f < t, end = t - 1;
    first = (hit & (row < first)) ? row : first;
    last = hit ? row : last;
    low = (hit & (f < low)) ? f : low;
    high = (hit & (high < end)) ? end : high;
    count += hit & (t - f);
  }
  seen = {first, last, low, high, count};
}

/// Bits [from, to) of eight rows of a word whose first bit is cell `first`.
inline void bits_between(const std::int32_t* from, const std::int32_t* to, int first, Words8& out) {
  const Numbers8 none{}, word = none + 64, offset = none + first;
  const Words8 all = ~Words8{};
  Numbers8 f, t;
  load(from, f);
  load(to, t);
  f -= offset, t -= offset;
  f = f < none ? none : f > word ? word : f;
  t = t < f ? f : t > word ? word : t;
  const Words8 begin = __builtin_convertvector(f, Words8), end = __builtin_convertvector(t, Words8);
  // by two shifts: one by 64 would be none
  const Words8 from_begin = (all << (begin >> 1)) << (begin - (begin >> 1));
  const Words8 from_end = (all << (end >> 1)) << (end - (end >> 1));
  out = from_begin & ~from_end;
}

/// Rows of one word, eight at a time.
PACKBED_WIDE void fill_rows(const std::int32_t* from, const std::int32_t* to, int n, int first,
                            std::uint64_t* row) {
  for (int j = 0; j < n; j += kWords8) {
    Words8 bits;
    bits_between(from + j, to + j, first, bits);
    store(bits, row + j);
  }
}
PACKBED_WIDE void clear_rows(const std::int32_t* from, const std::int32_t* to, int n, int first,
                             std::uint64_t* row) {
  for (int j = 0; j < n; j += kWords8) {
    Words8 bits, here;
    bits_between(from + j, to + j, first, bits);
    load(row + j, here);
    store(here & ~bits, row + j);
  }
}

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

/// An empty stamp with the cells of `box` in it and an empty border round it.
Stamp stamp_for(const Box& box) {
  Stamp stamp;
  stamp.low = {box.x.low - 1, box.y.low - 1, box.z.low - 1};
  stamp.size = {box.x.size() + 2, box.y.size() + 2, box.z.size() + 2};
  stamp.words = (stamp.size[0] + 63) / 64;
  stamp.rows = (stamp.size[1] + 7) / 8 * 8;
  stamp.ranges.resize(static_cast<std::size_t>(stamp.size[2]));
  stamp.bits.assign(2 * Stamp::kPad + static_cast<std::size_t>(stamp.size[2]) * stamp.slice(), 0);
  return stamp;
}

/// Rows [first, last] of a slice have cells. A border row on either side is in the range, for moves.
void set_range(Stamp& stamp, int slice, int first, int last) {
  const int eights = (last - first + 3 + 7) / 8, from = std::min(first - 1, stamp.rows - 8 * eights);
  stamp.ranges[static_cast<std::size_t>(slice)] = {static_cast<std::uint16_t>(from),
                                                   static_cast<std::uint16_t>(eights)};
}

/// Rows of word `w` of the slice `k` of the box that stamp_for was asked for.
std::uint64_t* rows_of(Stamp& stamp, int k, int w) {
  return stamp.data() + static_cast<std::size_t>(k + 1) * stamp.slice() +
         static_cast<std::size_t>(w) * stamp.column() + 1;
}

/// All ranges, out of the bits.
void set_ranges(Stamp& stamp) {
  for (int z = 1; z + 1 < stamp.size[2]; ++z) {
    Extent span;
    for (int w = 0; w < stamp.words; ++w) {
      const std::uint64_t* row = rows_of(stamp, z - 1, w) - 1;
      for (int y = 1; y + 1 < stamp.size[1]; ++y)
        if (row[y]) span.add(y);
    }
    if (span.low <= span.high) set_range(stamp, z, span.low, span.high);
  }
}

/// The cells of the intervals; row 0 of their box is y = box.y from the pellet's cell, and so on; x = 0 is
/// `x_first` from it. Without the cells of `bore`, when given, which has the same box.
Stamp stamp_of(const RowIntervals& rows, const RowIntervals* bore, int x_first) {
  std::vector<Extent> spans(static_cast<std::size_t>(rows.box.nz));  // of the rows of each slice
  Box box;
  std::int64_t count = 0;
  for (int k = 0; k < rows.box.nz; ++k) {
    SliceExtent seen;
    look_at_slice(rows.from.data() + rows.at(k), rows.to.data() + rows.at(k), rows.stride(), seen);
    const std::int64_t before = count;
    Extent& span = spans[static_cast<std::size_t>(k)];
    for (int l = 0; l < kWords8; ++l) {
      count += seen.count[l];
      span.add(seen.first[l], seen.last[l]);
      box.x.add(seen.low[l], seen.high[l]);
    }
    if (count == before) continue;
    box.y.add(span.low, span.high);
    box.z.add(k);
  }
  if (count == 0) return {};
  Stamp stamp = stamp_for(box);
  for (int k = 0; k < box.z.size(); ++k) {
    const Extent& span = spans[static_cast<std::size_t>(box.z.low + k)];
    set_range(stamp, k + 1, span.low - box.y.low + 1, span.high - box.y.low + 1);
    for (int w = 0; w < stamp.words; ++w) {
      const std::size_t at = rows.at(box.z.low + k) + static_cast<std::size_t>(span.low);
      // eight rows may reach beyond the last one, where the intervals have nothing either
      const int first = box.x.low - 1 + 64 * w;
      std::uint64_t* to = rows_of(stamp, k, w) + (span.low - box.y.low);
      fill_rows(rows.from.data() + at, rows.to.data() + at, span.size(), first, to);
      if (bore) clear_rows(bore->from.data() + at, bore->to.data() + at, span.size(), first, to);
    }
  }
  stamp.low[0] += x_first;
  stamp.low[1] += rows.box.y;
  stamp.low[2] += rows.box.z;
  stamp.count = bore ? count_bits(stamp.bits.data(), stamp.bits.size()) : count;
  return stamp;
}

/// First whole number and how many of them lie in [low, high], and one more on either side.
void whole_numbers(double low, double high, int& first, int& count) {
  first = static_cast<int>(std::floor(low)) - 1;
  count = static_cast<int>(std::ceil(high)) + 2 - first;
}

}  // namespace

Stamp stamp_of(const BitBlock& block, int middle) {
  const Box box = box_of(block);
  if (box.x.low > box.x.high) return {};
  Stamp stamp = stamp_for(box);
  for (int k = 0; k < box.z.size(); ++k)
    for (int w = 0; w < stamp.words; ++w) {
      std::uint64_t* to = rows_of(stamp, k, w);
      const std::uint64_t* from = block.row(box.y.low, box.z.low + k);
      if (block.words == 1 && stamp.words == 1)
        move_rows(from, box.y.size(), box.x.low - 1, to);
      else
        for (int j = 0; j < box.y.size();
             ++j, from += block.words)  // the border reaches a bit before the row
          to[j] = bits_from(box.x.low - 1 + 64 * w,
                            [&](int i) { return i >= 0 && i < block.words ? from[i] : std::uint64_t{0}; });
    }
  set_ranges(stamp);
  stamp.low[0] += 64 * block.word - middle;
  stamp.low[1] += block.y - middle;
  stamp.low[2] += block.z - middle;
  stamp.count = block.count >= 0 ? block.count : count_bits(stamp.bits.data(), stamp.bits.size());
  return stamp;
}

Window window_of(const Stamp& stamp, std::uint64_t* lattice, std::size_t column, std::size_t slice, int x,
                 int y, int z) {
  Window w{};
  w.lattice = lattice + static_cast<std::size_t>(z) * slice + static_cast<std::size_t>(x / 64) * column +
              static_cast<std::size_t>(y);
  w.lattice_column = column;
  w.lattice_slice = slice;
  w.shift = x % 64;
  w.stamp = stamp.data();
  w.stamp_column = stamp.column();
  w.stamp_slice = stamp.slice();
  w.slices = stamp.size[2];
  w.words = stamp.words;
  w.narrow = w.shift + stamp.size[0] <= 64;
  w.ranges = stamp.ranges.data();
  return w;
}

StampMaker::StampMaker(double pitch, double largest)
    : frame_(frame_round(pitch, largest)), middle_(frame_.size[0] / 2), rasteriser_(frame_) {}

Stamp StampMaker::make(const Shape& shape, double scale, const Quat& rotation, const Vec3& phase) {
  if (shape.kind == ShapeClass::cylinder || shape.kind == ShapeClass::tube)
    return make_cylinder(shape, scale / frame_.pitch, rotation, phase);
  const Vec3 centre = frame_.pitch * (phase.array() + (middle_ + 0.5)).matrix();
  return stamp_of(rasteriser_.body(shape, {centre, rotation}, scale, 0, frame_.size[2]), middle_);
}

Stamp StampMaker::make_cylinder(const Shape& shape, double scale, const Quat& rotation, const Vec3& phase) {
  const double radius = scale * shape.radius, half = scale * shape.half_height;
  const Vec3 axis = rotation * Vec3::UnitZ();
  const Vec3 reach = reach_of_cylinder(axis, radius, half);
  int x_first, length;
  whole_numbers(phase.x() - reach.x(), phase.x() + reach.x(), x_first, length);
  whole_numbers(phase.y() - reach.y(), phase.y() + reach.y(), rows_.box.y, rows_.box.ny);
  whole_numbers(phase.z() - reach.z(), phase.z() + reach.z(), rows_.box.z, rows_.box.nz);
  const Vec3 centre = phase - Vec3(x_first, 0, 0);
  cylinder_intervals(centre, axis, radius, half, length, rows_);
  if (!(shape.inner_radius > 0)) return stamp_of(rows_, nullptr, x_first);
  bore_.box = rows_.box;
  cylinder_intervals(centre, axis, scale * shape.inner_radius, half, length, bore_);
  return stamp_of(rows_, &bore_, x_first);
}

Vec3 StampMaker::first_phase() {
  static const Vec3 phase = phase_of(0);
  return phase;
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
