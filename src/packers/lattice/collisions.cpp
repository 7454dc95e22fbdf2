#include "packers/lattice/collisions.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "math/simd.hpp"
#include "math/with_first.hpp"

namespace packbed::lattice {
namespace {

constexpr int kLane = 16;

/// Round all cells that were hit, of a pellet in the cell `at`.
CellBox box_of_hits(const Tried& tried, const Cell& at) {
  CellBox box{at, at};
  Cell low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), tried.hits.front().slice},
      high{0, 0, tried.hits.back().slice};  // the hits come slice by slice
  for (const HitRow& r : tried.hits) {
    low[0] = std::min(low[0], 64 * r.word + std::countr_zero(r.bits));
    high[0] = std::max(high[0], 64 * r.word + 63 - std::countl_zero(r.bits));
    low[1] = std::min(low[1], r.row);
    high[1] = std::max(high[1], r.row);
  }
  for (std::size_t d = 0; d < 3; ++d) {
    const int corner = tried.by[d] + tried.stamp.low[d];
    box.low[d] += corner + low[d];
    box.high[d] += corner + high[d] + 1;
  }
  return box;
}

bool meet(const CellBox& a, const CellBox& b) {
  for (std::size_t d = 0; d < 3; ++d)
    if (a.low[d] >= b.high[d] || b.low[d] >= a.high[d]) return false;
  return true;
}

/// Adds (x, y, z) - c over its length to `sum`, lane by lane (n whole lanes).
PACKBED_WIDE void add_directions(const float* x, const float* y, const float* z, std::size_t n,
                                 const float* c, float* sum) {
  float sx[kLane] = {}, sy[kLane] = {}, sz[kLane] = {};
  const float cx = c[0], cy = c[1], cz = c[2];
  for (std::size_t i = 0; i < n; i += kLane)
    for (std::size_t l = 0; l < kLane; ++l) {
      const float ax = x[i + l] - cx, ay = y[i + l] - cy, az = z[i + l] - cz;
      const float length = std::sqrt(ax * ax + ay * ay + az * az);
      const float part = 1.0F / (length > 1e-3F ? length : 1e-3F);
      sx[l] += ax * part;
      sy[l] += ay * part;
      sz[l] += az * part;
    }
  for (std::size_t l = 0; l < kLane; ++l) {
    sum[0] += sx[l];
    sum[1] += sy[l];
    sum[2] += sz[l];
  }
}

/// Sum of the unit vectors from `centre` to all cells; nothing of a cell at the centre. Pads the columns.
Vec3 sum_of_directions(CellColumns& cells, const Vec3& centre) {
  const float c[3] = {static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                      static_cast<float>(centre.z())};
  while (cells.x.size() % kLane != 0) {
    cells.x.push_back(c[0]);
    cells.y.push_back(c[1]);
    cells.z.push_back(c[2]);
  }
  float sum[3] = {0, 0, 0};
  add_directions(cells.x.data(), cells.y.data(), cells.z.data(), cells.x.size(), c, sum);
  return {sum[0], sum[1], sum[2]};
}

Push push_of(CellColumns& cells, std::size_t pellet, const Vec3& centre, const Vec3& face) {
  Push p;
  p.pellet = static_cast<std::uint32_t>(pellet);
  const double n = static_cast<double>(cells.x.size());
  const Vec3 arms = Vec3(cells.sum[0], cells.sum[1], cells.sum[2]) - n * centre;
  p.torque = arms.cross(face);
  p.force = -sum_of_directions(cells, centre);
  return p;
}

}  // namespace

void CellColumns::clear() {
  x.clear();
  y.clear();
  z.clear();
  sum = {0, 0, 0};
}

void CellColumns::add(std::uint64_t bits, int x0, int y0, int z0) {
  for (; bits; bits &= bits - 1) {
    const int here = x0 + std::countr_zero(bits);
    x.push_back(static_cast<float>(here));
    y.push_back(static_cast<float>(y0));
    z.push_back(static_cast<float>(z0));
    sum[0] += here;
    sum[1] += y0;
    sum[2] += z0;
  }
}

void Collisions::find_others(const State& state, std::size_t i, const Tried& tried) {
  count_ = last_ = 0;
  if (tried.hits.empty()) return;
  const CellBox box = box_of_hits(tried, state.cell[i]);
  for (std::uint32_t k = state.near_from[i]; k < state.near_from[i + 1]; ++k) {
    const std::uint32_t j = state.near[k];
    if (std::abs(state.slab[j] - state.slab[i]) > 1) continue;  // out of reach, and perhaps on the move
    if (!meet(box, state.box[j])) continue;
    if (count_ == others_.size()) others_.emplace_back();
    Other& other = others_[count_++];
    other.pellet = j;
    other.stamp = &state.stamp[j];
    for (std::size_t d = 0; d < 3; ++d) {
      other.offset[d] = state.cell[j][d] - state.cell[i][d];
      other.corner[d] = other.offset[d] + other.stamp->low[d];
    }
    other.cells.clear();
  }
}

void Collisions::attribute(std::uint64_t bits, int x, int y, int z) {
  const std::size_t first = last_;  // the one that had the last cells
  for (std::size_t k = 0; k < count_ && bits; ++k) {
    const std::size_t at = with_first(first, k);
    Other& other = others_[at];
    const Cell &o = other.offset, &corner = other.corner;
    const std::uint64_t its = bits & box_bits(*other.stamp, x - corner[0], y - corner[1], z - corner[2]);
    if (!its) continue;
    other.cells.add(its, x - o[0], y - o[1], z - o[2]);
    bits &= ~its;
    last_ = at;
  }  // what is left is the wall's
}

void Collisions::push(const State& state, std::size_t i, const Tried& tried, std::vector<Push>& pushes) {
  own_.clear();
  find_others(state, i, tried);
  for (const HitRow& r : tried.hits) {
    const int x = tried.by[0] + tried.stamp.low[0] + 64 * r.word,
              y = tried.by[1] + tried.stamp.low[1] + r.row, z = tried.by[2] + tried.stamp.low[2] + r.slice;
    own_.add(r.bits, x, y, z);
    attribute(r.bits, x, y, z);
  }
  pushes.push_back(push_of(own_, i, tried.phase, tried.face));
  for (std::size_t k = 0; k < count_; ++k)
    if (Other& other = others_[k]; !other.cells.x.empty())
      pushes.push_back(push_of(other.cells, other.pellet, state.phase[other.pellet], -tried.face));
}

}  // namespace packbed::lattice
