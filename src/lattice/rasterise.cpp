#include "lattice/rasterise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace packbed {
namespace {

using Wide = __int128;
/// Meshes up to so many snapped units wide are scan-converted in 64 bits: products of three lengths stay
/// below 2^62.
constexpr std::int64_t kNarrow = std::int64_t{1} << 19;

/// Smallest whole number >= num / den for den > 0, exact; inverse is 1 / den, rounded.
template <class Int>
Int ceil_div(Int num, Int den, double inverse) {
  Int q = static_cast<Int>(static_cast<double>(num) * inverse) + 1;
  Int rest = q * den - num;  // wanted in [0, den)
  while (rest < 0) {
    ++q;
    rest += den;
  }
  while (rest >= den) {
    --q;
    rest -= den;
  }
  return q;
}

std::int64_t ceil_snap(std::int64_t u) {
  return -((-u) >> 12);
}
static_assert(kSnap == 1 << 12);

/// Where an edge of the mesh crosses slice after slice: y as the first whole row at or beyond the crossing.
template <class Int>
class EdgeWalk {
 public:
  /// From (y0, z0) up to (y1, z1), z0 < z1, starting at slice k.
  EdgeWalk(std::int64_t y0, std::int64_t z0, std::int64_t y1, std::int64_t z1, std::int64_t k)
      : den_(static_cast<Int>(z1 - z0) * kSnap),
        inverse_(1.0 / static_cast<double>(den_)),
        num_(static_cast<Int>(y0) * (z1 - z0) + static_cast<Int>(k * kSnap - z0) * (y1 - y0)),
        step_(static_cast<Int>(y1 - y0) * kSnap) {}
  std::int64_t next() {
    const Int q = ceil_div(num_, den_, inverse_);
    num_ += step_;
    return static_cast<std::int64_t>(q);
  }

 private:
  Int den_;
  double inverse_;
  Int num_, step_;
};

std::uint64_t prefix_xor(std::uint64_t w) {
  w ^= w << 1;
  w ^= w << 2;
  w ^= w << 4;
  w ^= w << 8;
  w ^= w << 16;
  w ^= w << 32;
  return w;
}

/// Calls change(word, bits) with bits [from, to) of a row, word by word.
template <class Change>
void in_words(std::uint64_t* row, int from, int to, const Change& change) {
  if (to <= from) return;
  const int first = from / 64, last = (to - 1) / 64;
  for (int w = first; w <= last; ++w) {
    const std::uint64_t head = w == first ? ~std::uint64_t{0} << (from % 64) : ~std::uint64_t{0},
                        tail = w == last ? ~std::uint64_t{0} >> (63 - (to - 1) % 64) : ~std::uint64_t{0};
    change(row[w], head & tail);
  }
}
void fill(std::uint64_t* row, int from, int to) {
  in_words(row, from, to, [](std::uint64_t& word, std::uint64_t bits) { word |= bits; });
}
void clear(std::uint64_t* row, int from, int to) {
  in_words(row, from, to, [](std::uint64_t& word, std::uint64_t bits) { word &= ~bits; });
}

int floor_div(int a, int b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

}  // namespace

// Box of voxels whose centres may lie between low and high [voxels, centres at whole numbers].
bool Rasteriser::set_box(const Vec3& low, const Vec3& high, int z_begin, int z_end) {
  BitBlock& b = block_;
  b.ny = b.nz = b.words = 0;
  b.count = -1;
  b.bits.clear();
  constexpr double kFar = 1e9;  // a body so far away has no voxels here
  if (!(low.cwiseAbs().maxCoeff() < kFar) || !(high.cwiseAbs().maxCoeff() < kFar)) return false;
  const auto floor_int = [](double v) { return static_cast<int>(std::floor(v)); };
  const int x0 = floor_int(low.x()), x1 = floor_int(high.x()) + 1;
  b.y = std::max(0, floor_int(low.y()));
  b.z = std::max(z_begin, floor_int(low.z()));
  const int ny = std::min(frame_.size[1], floor_int(high.y()) + 2) - b.y;
  const int nz = std::min(z_end, floor_int(high.z()) + 2) - b.z;
  if (ny <= 0 || nz <= 0 || x1 < 0 || x0 >= frame_.size[0]) return false;
  b.ny = ny;
  b.nz = nz;
  b.word = floor_div(x0, 64);
  b.words = floor_div(x1 + 1, 64) - b.word + 1;
  b.bits.assign(
      static_cast<std::size_t>(b.ny) * static_cast<std::size_t>(b.nz) * static_cast<std::size_t>(b.words), 0);
  return true;
}

void Rasteriser::sphere(const Vec3& centre, double radius) {
  const double base = 64.0 * block_.word;
  for (int k = 0; k < block_.nz; ++k)
    for (int j = 0; j < block_.ny; ++j) {
      const double dy = block_.y + j - centre.y(), dz = block_.z + k - centre.z();
      const double rest = radius * radius - dy * dy - dz * dz;
      if (rest < 0) continue;
      const double half = std::sqrt(rest), x = centre.x() - base;
      fill(block_.row(j, k), static_cast<int>(std::ceil(x - half)), static_cast<int>(std::ceil(x + half)));
    }
}

void Rasteriser::cylinder(const Vec3& centre, const Vec3& axis, double radius, double bore,
                          double half_height) {
  intervals_.box = {block_.y, block_.ny, block_.z, block_.nz};
  const Vec3 from_block = centre - Vec3(64.0 * block_.word, 0, 0);
  const auto in_rows = [&](double r, const auto& change) {
    cylinder_intervals(from_block, axis, r, half_height, 64 * block_.words, intervals_);
    for (int k = 0; k < block_.nz; ++k) {
      const std::int32_t *from = intervals_.from.data() + intervals_.at(k),
                         *to = intervals_.to.data() + intervals_.at(k);
      for (int j = 0; j < block_.ny; ++j) change(block_.row(j, k), from[j], to[j]);
    }
  };
  block_.count = 0;
  in_rows(radius, [&](std::uint64_t* row, int from, int to) {
    fill(row, from, to);
    block_.count += std::max(0, to - from);
  });
  if (bore > 0)
    in_rows(bore, [&](std::uint64_t* row, int from, int to) {
      clear(row, from, to);  // its cells are the cylinder's
      block_.count -= std::max(0, to - from);
    });
}

template <class Int>
void Rasteriser::triangle(const Corner& a, const Corner& b, const Corner& c) {
  // normal by the cross product of two edges; its x component is twice the area seen along x
  const Int uy = b.y - a.y, uz = b.z - a.z, ux = b.x - a.x, vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  Int nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  if (nx == 0) return;
  if (nx < 0) {
    nx = -nx;
    ny = -ny;
    nz = -nz;
  }
  const Corner *p0 = &a, *p1 = &b, *p2 = &c;  // by height
  if (p1->z < p0->z) std::swap(p0, p1);
  if (p2->z < p1->z) std::swap(p1, p2);
  if (p1->z < p0->z) std::swap(p0, p1);
  const std::int64_t k_low = block_.z - corner_base_[2], j_low = block_.y - corner_base_[1];
  const std::int64_t begin = std::max(ceil_snap(p0->z), k_low);
  const std::int64_t end = std::min(ceil_snap(p2->z), k_low + block_.nz),
                     bend = std::clamp(ceil_snap(p1->z), begin, std::max(begin, end));
  const Int den = nx * kSnap;
  const double inverse = 1.0 / static_cast<double>(den);
  const std::int64_t base = corner_base_[0] - 64 * static_cast<std::int64_t>(block_.word);

  const auto rows = [&](const Corner& from, const Corner& to, std::int64_t first, std::int64_t last) {
    if (first >= last) return;
    EdgeWalk<Int> long_edge(p0->y, p0->z, p2->y, p2->z, first), short_edge(from.y, from.z, to.y, to.z, first);
    for (std::int64_t k = first; k < last; ++k) {
      std::int64_t low = long_edge.next(), high = short_edge.next();
      if (low > high) std::swap(low, high);
      low = std::max(low, j_low);
      high = std::min(high, j_low + block_.ny);
      if (low >= high) continue;
      Int num = nx * a.x - ny * static_cast<Int>(low * kSnap - a.y) - nz * static_cast<Int>(k * kSnap - a.z);
      std::uint64_t* row = block_.row(static_cast<int>(low - j_low), static_cast<int>(k - k_low));
      for (std::int64_t j = low; j < high; ++j, num -= ny * kSnap, row += block_.words) {
        const std::int64_t bit = static_cast<std::int64_t>(ceil_div(num, den, inverse)) + base;
        row[bit >> 6] ^= std::uint64_t{1} << (bit & 63);
      }
    }
  };
  rows(*p0, *p1, begin, bend);
  rows(*p1, *p2, bend, end);
}

void Rasteriser::close_rows() {
  const std::size_t words = static_cast<std::size_t>(block_.words);
  for (std::size_t r = 0; r < block_.bits.size(); r += words) {
    std::uint64_t inside = 0;  // all ones while the row is inside the body
    for (std::size_t w = r; w < r + words; ++w) {
      if (block_.bits[w] != 0 || inside != 0) block_.bits[w] = prefix_xor(block_.bits[w]) ^ inside;
      inside = std::uint64_t{0} - (block_.bits[w] >> 63);
    }
    ++rows_;
    if (inside) ++open_rows_;
  }
}

// Small triangles often lie between two rows, or two slices; they are left out without a branch for each.
void Rasteriser::find_crossing(const TriangleMesh& surface) {
  crossing_.resize(surface.triangles.size());
  std::size_t n = 0;
  for (std::size_t k = 0; k < surface.triangles.size(); ++k) {
    const auto [a, b, c] = corners_of(surface.triangles[k]);
    const auto spans = [](std::int64_t u, std::int64_t v, std::int64_t w) {
      return ceil_snap(std::min(u, std::min(v, w))) < ceil_snap(std::max(u, std::max(v, w)));
    };
    crossing_[n] = static_cast<std::uint32_t>(k);
    n += static_cast<std::size_t>(spans(a.y, b.y, c.y)) & static_cast<std::size_t>(spans(a.z, b.z, c.z));
  }
  crossing_.resize(n);
}

const BitBlock& Rasteriser::mesh(const TriangleMesh& surface, const Pose& pose, double scale, int z_begin,
                                 int z_end) {
  const Mat3 rotation = pose.rotation.toRotationMatrix() * (scale / frame_.pitch);
  const Vec3 shift = (pose.position - frame_.origin) / frame_.pitch - Vec3::Constant(0.5);
  posed_.resize(surface.vertices.size());
  Vec3 low = Vec3::Constant(INFINITY), high = -low;
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    posed_[i] = rotation * surface.vertices[i] + shift;
    low = low.cwiseMin(posed_[i]);
    high = high.cwiseMax(posed_[i]);
  }
  if (posed_.empty() || !set_box(low, high, z_begin, z_end)) {
    block_.nz = block_.ny = 0;
    return block_;
  }
  for (int d = 0; d < 3; ++d)
    corner_base_[static_cast<std::size_t>(d)] = static_cast<std::int64_t>(std::floor(low[d]));
  const Vec3 base(static_cast<double>(corner_base_[0]), static_cast<double>(corner_base_[1]),
                  static_cast<double>(corner_base_[2]));
  corners_.resize(posed_.size());
  const auto snap = [](double v) {
    return static_cast<std::int64_t>(std::nearbyint(v * static_cast<double>(kSnap)));
  };
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    const Vec3 local = posed_[i] - base;
    corners_[i] = {snap(local.x()), snap(local.y()), snap(local.z())};
  }
  const bool narrow =
      ((high - base).maxCoeff() + 1) * static_cast<double>(kSnap) < static_cast<double>(kNarrow);
  find_crossing(surface);
  for (const std::uint32_t k : crossing_) {
    const auto [a, b, c] = corners_of(surface.triangles[k]);
    if (narrow)
      triangle<std::int64_t>(a, b, c);
    else
      triangle<Wide>(a, b, c);
  }
  close_rows();
  return block_;
}

const BitBlock& Rasteriser::body(const Shape& shape, const Pose& pose, double scale, int z_begin, int z_end) {
  if (shape.kind == ShapeClass::mesh || shape.kind == ShapeClass::convex)
    return mesh(shape.surface, pose, scale, z_begin, z_end);
  const Vec3 centre = (pose.position - frame_.origin) / frame_.pitch - Vec3::Constant(0.5);
  const double size = scale / frame_.pitch, radius = shape.radius * size, half = shape.half_height * size;
  if (shape.kind == ShapeClass::sphere) {
    if (set_box(centre.array() - radius, centre.array() + radius, z_begin, z_end)) sphere(centre, radius);
    return block_;
  }
  const Vec3 a = pose.rotation * Vec3::UnitZ();
  const Vec3 reach = reach_of_cylinder(a, radius, half);
  if (set_box(centre - reach, centre + reach, z_begin, z_end))
    cylinder(centre, a, radius, size * shape.inner_radius, half);
  return block_;
}

namespace {

void label_bits(std::uint64_t bits, std::int32_t* voxel, std::int32_t label) {
  for (; bits; bits &= bits - 1) {
    std::int32_t& here = voxel[std::countr_zero(bits)];
    if (here == 0) here = label;
  }
}

}  // namespace

std::int64_t merge(const BitBlock& block, VoxelGrid& grid, std::int32_t label) {
  std::int64_t doubled = 0;
  const int words = static_cast<int>(grid.frame.words_per_row()), nx = grid.frame.size[0];
  const int first = std::max(0, -block.word), last = std::min(block.words, words - block.word);
  const std::uint64_t tail = nx % 64 == 0 ? ~std::uint64_t{0} : ~(~std::uint64_t{0} << (nx % 64));
  for (int k = 0; k < block.nz; ++k)
    for (int j = 0; j < block.ny; ++j) {
      const std::uint64_t* from = block.row(j, k);
      std::uint64_t* to = grid.words.data() + grid.row(block.y + j, block.z + k);
      for (int w = first; w < last; ++w) {
        const int word = block.word + w;
        const std::uint64_t bits = word == words - 1 ? from[w] & tail : from[w];
        if (bits == 0) continue;
        if (const std::uint64_t both = to[word] & bits) doubled += std::popcount(both);
        to[word] |= bits;
        if (!grid.labels.empty()) {
          const std::size_t row =
              (static_cast<std::size_t>(block.z + k) * static_cast<std::size_t>(grid.frame.size[1]) +
               static_cast<std::size_t>(block.y + j)) *
              static_cast<std::size_t>(nx);
          label_bits(bits, grid.labels.data() + row + 64 * static_cast<std::size_t>(word), label);
        }
      }
    }
  return doubled;
}

}  // namespace packbed
