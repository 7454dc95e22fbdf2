#include "lattice/digital_rotation.hpp"

#include <algorithm>
#include <cmath>

#include "math/random.hpp"

namespace packbed {
namespace {

/// A cube of cells round the pellet's own, a byte each.
class Block {
 public:
  explicit Block(int half)
      : half_(half), edge_(2 * half + 1), solid_(static_cast<std::size_t>(edge_ * edge_ * edge_)) {}
  std::uint8_t& at(int x, int y, int z) {
    return solid_[static_cast<std::size_t>(((z + half_) * edge_ + y + half_) * edge_ + x + half_)];
  }
  bool has(int x, int y, int z) {
    return std::max({std::abs(x), std::abs(y), std::abs(z)}) <= half_ && at(x, y, z);
  }
  int neighbours(int x, int y, int z) {  // of the 26
    int n = -at(x, y, z);
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) n += has(x + i, y + j, z + k);
    return n;
  }
  /// Some face looks at a cell of the other kind.
  bool at_surface(int x, int y, int z) {
    const bool own = has(x, y, z);
    return has(x + 1, y, z) != own || has(x - 1, y, z) != own || has(x, y + 1, z) != own ||
           has(x, y - 1, z) != own || has(x, y, z + 1) != own || has(x, y, z - 1) != own;
  }
  int half() const { return half_; }

 private:
  int half_, edge_;
  std::vector<std::uint8_t> solid_;
};

/// How far a stamp reaches from its cell, in any direction [cells].
int reach_of(const Stamp& stamp) {
  double far = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double most = std::max(std::abs(stamp.low[d]), std::abs(stamp.low[d] + stamp.size[d] - 1));
    far += most * most;
  }
  return static_cast<int>(std::ceil(std::sqrt(far)));
}

/// Takes or fills up to `wanted` surface cells, the most exposed or the most enclosed first; equal ones in an
/// order that prefers no direction.
std::int64_t mend(Block& block, bool fill, std::int64_t wanted) {
  struct Candidate {
    int rank;
    std::uint32_t lot;
    Cell cell;
  };
  std::vector<Candidate> found;
  const int h = block.half() - 1;
  for (int z = -h; z <= h; ++z)
    for (int y = -h; y <= h; ++y)
      for (int x = -h; x <= h; ++x) {
        if (static_cast<bool>(block.at(x, y, z)) == fill || !block.at_surface(x, y, z)) continue;
        const int n = block.neighbours(x, y, z);
        const auto bits = [](int v) { return static_cast<std::uint32_t>(v); };
        found.push_back({fill ? -n : n, philox4x32({bits(x), bits(y), bits(z), 0}, {0, 0})[0], {x, y, z}});
      }
  const auto take = std::min<std::int64_t>(wanted, static_cast<std::int64_t>(found.size()));
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.lot != b.lot ? a.lot < b.lot : a.cell < b.cell;
  });
  for (std::int64_t k = 0; k < take; ++k) {
    const Cell& c = found[static_cast<std::size_t>(k)].cell;
    block.at(c[0], c[1], c[2]) = fill;
  }
  return take;
}

BitBlock bits_of(Block& block) {
  BitBlock out;
  const int h = block.half(), edge = 2 * h + 1;
  out.words = (edge + 63) / 64;
  out.ny = out.nz = edge;
  out.bits.assign(static_cast<std::size_t>(edge * edge * out.words), 0);
  for (int z = 0; z < edge; ++z)
    for (int y = 0; y < edge; ++y)
      for (int x = 0; x < edge; ++x)
        if (block.at(x - h, y - h, z - h)) out.row(y, z)[x / 64] |= std::uint64_t{1} << (x % 64);
  return out;
}

}  // namespace

Stamp turn_cells(const Stamp& stamp, const Vec3& phase, const Quat& turn) {
  Block block(reach_of(stamp) + 2);
  const Mat3 back = turn.conjugate().toRotationMatrix();
  const int h = block.half() - 1;
  std::int64_t count = 0;
  for (int z = -h; z <= h; ++z)
    for (int y = -h; y <= h; ++y) {
      const Vec3 row = back * (Vec3(0, y, z) - phase) + phase;
      for (int x = -h; x <= h; ++x) {
        const Vec3 from = row + x * back.col(0);
        const auto nearest = [&](int d) { return static_cast<int>(std::floor(from[d] + 0.5)); };
        if (!has_cell(stamp, {nearest(0), nearest(1), nearest(2)})) continue;
        block.at(x, y, z) = 1;
        ++count;
      }
    }
  while (count != stamp.count && count > 0) {
    const bool fill = count < stamp.count;
    const std::int64_t made = mend(block, fill, std::abs(stamp.count - count));
    count += fill ? made : -made;
    if (made == 0) break;
  }
  return stamp_of(bits_of(block), block.half());
}

double wear(const Stamp& worn, const Stamp& drawn) {
  std::int64_t shared = 0;
  for_each_cell(drawn, [&](int x, int y, int z) { shared += has_cell(worn, {x, y, z}); });
  return static_cast<double>(worn.count + drawn.count - 2 * shared) / static_cast<double>(drawn.count);
}

}  // namespace packbed
