#include "contact/depth_field.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

#include "math/simd.hpp"
#include "math/threads.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

constexpr std::int32_t kOutside = -1, kDeep = -2;
// Coarse spacing in fine ones. The bound loses up to 0.87 coarse spacings: larger culls less, smaller leaves
// the cache.
constexpr double kCoarse = 3;

// What the splines may differ from the distance near an edge, in spacings.
constexpr double kRounding = 0.3;

struct Grid {
  double x0, y0, z0, per_spacing;
  std::int32_t nx, ny, nz;  // blocks
  const std::int32_t* block;
  const float* coefficient;
  double plateau, steepest;
  const EdgeBlocks* fine;  // none: nothing is added
};

/// What the fine splines add at (u, v, w), spacings from the corner of the block. Derivatives per coarse
/// spacing.
inline __attribute__((always_inline)) SplineValue fine_at(const Grid& grid, std::int32_t block, double u,
                                                          double v, double w) {
  const std::int32_t first = grid.fine->first[static_cast<std::size_t>(block)];
  if (first < 0) return {};
  const double fu = kFiner * u, fv = kFiner * v, fw = kFiner * w;
  const std::int32_t iu = static_cast<std::int32_t>(fu), iv = static_cast<std::int32_t>(fv),
                     iw = static_cast<std::int32_t>(fw);
  const std::int32_t sub = ((iw / kBlock) * kFiner + iv / kBlock) * kFiner + iu / kBlock;
  const std::int32_t fine = grid.fine->block[static_cast<std::size_t>(first + sub)];
  if (fine < 0) return {};
  const float* row = &grid.fine->coefficient[static_cast<std::size_t>(fine) * kBlockSize +
                                             cell_of_block(iu % kBlock, iv % kBlock, iw % kBlock)];
  const SplineValue f = spline_at(row, fu - iu - 0.5, fv - iv - 0.5, fw - iw - 0.5);
  return {f.value, kFiner * f.x, kFiner * f.y, kFiner * f.z};
}

PACKBED_WIDE void evaluate_grid(const Grid& grid, const DepthBatch& batch) {
  const double spacing = 1 / grid.per_spacing, flatter = 1 / grid.steepest;
  for (std::size_t i = 0; i < batch.count; ++i) {
    batch.depth[i] = -spacing;  // what is not in a block, or in one without coefficients, is farther away
    batch.gx[i] = batch.gy[i] = batch.gz[i] = 0;
    const double u = (batch.x[i] - grid.x0) * grid.per_spacing, v = (batch.y[i] - grid.y0) * grid.per_spacing,
                 w = (batch.z[i] - grid.z0) * grid.per_spacing;
    if (!(u > -0.5 && v > -0.5 && w > -0.5 && u < 1e9 && v < 1e9 && w < 1e9)) continue;
    const std::int32_t iu = static_cast<std::int32_t>(u + 0.5), iv = static_cast<std::int32_t>(v + 0.5),
                       iw = static_cast<std::int32_t>(w + 0.5);
    const std::int32_t bu = iu / kBlock, bv = iv / kBlock, bw = iw / kBlock;
    if (bu >= grid.nx || bv >= grid.ny || bw >= grid.nz) continue;
    const std::int32_t block = grid.block[(bw * grid.ny + bv) * grid.nx + bu];
    if (block == kDeep) batch.depth[i] = grid.plateau;
    if (block < 0) continue;
    const float* row = grid.coefficient + static_cast<std::size_t>(block) * kBlockSize +
                       cell_of_block(iu % kBlock, iv % kBlock, iw % kBlock);
    // many points that come here are just outside: the distance at the node, less the way from it, shows it
    const double tu = u - iu, tv = v - iv, tw = w - iw;
    const double outside = -static_cast<double>(row[kRow * kRow + kRow + 1]) * grid.per_spacing - kRounding;
    const double away2 = tu * tu + tv * tv + tw * tw;
    if (outside > 0 && outside * outside > away2) {
      batch.depth[i] = (std::sqrt(away2) - outside) * spacing;
      continue;
    }
    SplineValue f = spline_at(row, tu, tv, tw);
    if (grid.fine)
      f = f + fine_at(grid, block, u + 0.5 - kBlock * bu, v + 0.5 - kBlock * bv, w + 0.5 - kBlock * bw);
    if (!(f.value > 0)) {
      batch.depth[i] = std::min(f.value * flatter, f.value + kRounding * spacing);
      continue;
    }
    batch.depth[i] = f.value;
    batch.gx[i] = f.x * grid.per_spacing;
    batch.gy[i] = f.y * grid.per_spacing;
    batch.gz[i] = f.z * grid.per_spacing;
  }
}

struct Coarse {
  double x0, y0, z0, spacing, per_spacing;
  double cx, cy, cz, hx, hy, hz;  // centre and half width of the body's box
  std::int32_t nx, ny, nz;
  const float* distance;
};

/// Lower bounds of the distance from the body, less the radius: from the nearest coarse node (the distance
/// changes by no more than one goes), and from the body's box.
PACKBED_WIDE void bound_grid(const Coarse& coarse, const SphereBatch& p, double* bound) {
  const double top_x = coarse.nx - 1, top_y = coarse.ny - 1, top_z = coarse.nz - 1;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double u = std::min(std::max((p.x[i] - coarse.x0) * coarse.per_spacing + 0.5, 0.0), top_x);
    const double v = std::min(std::max((p.y[i] - coarse.y0) * coarse.per_spacing + 0.5, 0.0), top_y);
    const double w = std::min(std::max((p.z[i] - coarse.z0) * coarse.per_spacing + 0.5, 0.0), top_z);
    const std::int32_t iu = static_cast<std::int32_t>(u), iv = static_cast<std::int32_t>(v),
                       iw = static_cast<std::int32_t>(w);
    const double x = p.x[i] - (coarse.x0 + iu * coarse.spacing),
                 y = p.y[i] - (coarse.y0 + iv * coarse.spacing),
                 z = p.z[i] - (coarse.z0 + iw * coarse.spacing);
    const double distance = static_cast<double>(coarse.distance[(iw * coarse.ny + iv) * coarse.nx + iu]);
    const double inner = distance - std::sqrt(x * x + y * y + z * z);
    const double ex = std::max(std::abs(p.x[i] - coarse.cx) - coarse.hx, 0.0),
                 ey = std::max(std::abs(p.y[i] - coarse.cy) - coarse.hy, 0.0),
                 ez = std::max(std::abs(p.z[i] - coarse.cz) - coarse.hz, 0.0);
    const double outer2 = ex * ex + ey * ey + ez * ez;
    bound[i] = (outer2 > 0 ? std::max(inner, std::sqrt(outer2)) : inner) - p.radius[i];
  }
}

/// Coefficients of minus the distance over one block; node after node is near, and so is what is nearest to
/// it.
void fill_with_depth(const TriangleTree& tree, const Vec3& first_node, double spacing, double deepest,
                     float* out) {
  double last = std::numeric_limits<double>::infinity();
  Vec3 last_node = Vec3::Zero();
  fill_block(out, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
    const Vec3 node = first_node + spacing * Vec3(i, j, k);
    const double bound = std::isinf(last) ? last : (std::abs(last) + (node - last_node).norm()) * (1 + 1e-9);
    last = tree.nearest(node, bound).distance;
    last_node = node;
    return deepest > 0 ? std::min(-last, deepest) : -last;
  });
}

double cube(double x) {
  return x * x * x;
}

}  // namespace

DepthField DepthField::of_sphere(double radius) {
  DepthField field;
  field.form_.kind = DepthKind::sphere;
  field.form_.radius = radius;
  return field;
}

DepthField DepthField::of_cylinder(double radius, double half_height) {
  DepthField field = of_sphere(radius);
  field.form_.kind = DepthKind::cylinder;
  field.form_.half_height = half_height;
  return field;
}

DepthField DepthField::of_tube(double radius, double inner_radius, double half_height) {
  DepthField field = of_cylinder(radius, half_height);
  field.form_.kind = DepthKind::tube;
  field.form_.inner_radius = inner_radius;
  return field;
}

DepthField DepthField::of_planes(const std::vector<Plane>& planes) {
  DepthField field;
  field.form_.kind = DepthKind::planes;
  for (const Plane& plane : planes) {
    field.form_.nx.push_back(plane.normal.x());
    field.form_.ny.push_back(plane.normal.y());
    field.form_.nz.push_back(plane.normal.z());
    field.form_.offset.push_back(plane.offset);
  }
  return field;
}

DepthField DepthField::of_floor() {
  DepthField field;
  field.form_.kind = DepthKind::floor;
  return field;
}

DepthField DepthField::of_bore(double radius) {
  DepthField field = of_sphere(radius);
  field.form_.kind = DepthKind::bore;
  return field;
}

DepthField DepthField::of_mesh(const TriangleMesh& mesh, double spacing, double deepest) {
  DepthField field;
  field.form_.kind = DepthKind::grid;
  field.spacing_ = spacing;
  const TriangleTree tree(mesh);
  const Box3 box = bounding_box(mesh);
  field.origin_ = box.min() - Vec3::Constant(2 * spacing);
  for (int k = 0; k < 3; ++k)
    field.blocks_[static_cast<std::size_t>(k)] =
        static_cast<std::int32_t>(std::ceil((box.sizes()[k] + 4 * spacing) / spacing / kBlock)) + 1;
  field.box_centre_ = box.center();
  field.box_half_ = 0.5 * box.sizes() + Vec3::Constant(kRounding * spacing);
  field.make_coarse(tree, box);
  const std::vector<Vec3> first_node = field.make_blocks(tree, deepest);
  if (deepest > 0) return field;
  field.edges_ =
      make_edge_blocks(mesh, tree, spacing, first_node, [&](const Vec3& x) { return field.splines(x); });
  field.steepest_ += field.edges_.steepest;
  return field;
}

void DepthField::make_coarse(const TriangleTree& tree, const Box3& box) {
  coarse_spacing_ = kCoarse * spacing_;
  coarse_origin_ = box.min() - Vec3::Constant(coarse_spacing_);
  std::size_t total = 1;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t n = static_cast<std::int32_t>(std::ceil(box.sizes()[k] / coarse_spacing_)) + 3;
    coarse_size_[static_cast<std::size_t>(k)] = n;
    total *= static_cast<std::size_t>(n);
  }
  coarse_.resize(total);
  const auto nx = static_cast<std::size_t>(coarse_size_[0]), ny = static_cast<std::size_t>(coarse_size_[1]);
  parallel_for(total, 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 index(static_cast<double>(i % nx), static_cast<double>(i / nx % ny),
                       static_cast<double>(i / nx / ny));
      const double d = tree.signed_distance(coarse_origin_ + coarse_spacing_ * index);
      // down by more than a float's rounding and by what the splines may add near an edge
      coarse_[i] = static_cast<float>(d - kRounding * spacing_ - 1e-6 * std::abs(d));
    }
  });
}

std::vector<Vec3> DepthField::make_blocks(const TriangleTree& tree, double deepest) {
  const double half_diagonal = 0.5 * kBlock * std::sqrt(3.0) * spacing_;
  plateau_ = deepest;
  const auto corner_node = [&](std::size_t i) {
    const auto nx = static_cast<std::size_t>(blocks_[0]), ny = static_cast<std::size_t>(blocks_[1]);
    const Vec3 index(static_cast<double>(i % nx), static_cast<double>(i / nx % ny),
                     static_cast<double>(i / nx / ny));
    return Vec3(origin_ + kBlock * spacing_ * index);
  };
  const std::size_t total = static_cast<std::size_t>(blocks_[0]) * static_cast<std::size_t>(blocks_[1]) *
                            static_cast<std::size_t>(blocks_[2]);
  block_.assign(total, 0);
  parallel_for(total, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double d = tree.signed_distance(corner_node(i) + Vec3::Constant(0.5 * (kBlock - 1) * spacing_));
      if (d > half_diagonal + spacing_) block_[i] = kOutside;
      if (deepest > 0 && d < -deepest - half_diagonal - 4 * spacing_) block_[i] = kDeep;
    }
  });
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < total; ++i)
    if (block_[i] == 0) {
      block_[i] = static_cast<std::int32_t>(used.size());
      used.push_back(i);
    }
  coefficient_.assign(used.size() * kBlockSize + 4, 0.0F);  // a row is read four at a time
  std::vector<double> steepest(used.size());
  std::vector<Vec3> first_node(used.size());
  parallel_for(used.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float* block = coefficient_.data() + i * kBlockSize;
      first_node[i] = corner_node(used[i]);
      fill_with_depth(tree, first_node[i], spacing_, deepest, block);
      steepest[i] = steepest_of(block) / spacing_;
    }
  });
  steepest_ = *std::max_element(steepest.begin(), steepest.end()) * (1 + 1e-6);
  return first_node;
}

double DepthField::splines(const Vec3& x) const {
  const Vec3 at = (x - origin_) / spacing_ + Vec3::Constant(0.5);
  const Eigen::Array3i node = at.array().floor().cast<std::int32_t>(), block = node / kBlock,
                       cell = node - kBlock * block;
  const std::int32_t of =
      block_[static_cast<std::size_t>((block.z() * blocks_[1] + block.y()) * blocks_[0] + block.x())];
  assert(of >= 0);
  const Vec3 t = at - node.matrix().cast<double>() - Vec3::Constant(0.5);
  return spline_at(&coefficient_[static_cast<std::size_t>(of) * kBlockSize +
                                 cell_of_block(cell.x(), cell.y(), cell.z())],
                   t.x(), t.y(), t.z())
      .value;
}

double DepthField::estimate_bytes(const TriangleMesh& mesh, double spacing, double deepest) {
  const double side = kBlock * spacing, bytes = sizeof(float) * cube(kRow);
  const Vec3 size = bounding_box(mesh).sizes() + Vec3::Constant(4 * spacing);
  const double box = size.prod() / cube(side) * bytes;
  if (!(deepest > 0)) return box + estimate_edge_bytes(mesh, spacing);
  double area = 0;
  for (const auto& t : mesh.triangles) area += triangle_area_vector(mesh, t).norm();
  // blocks whose centre is within half a diagonal, and a little, of the band
  return std::min(box,
                  area * (deepest + kBlock * std::sqrt(3.0) * spacing + 5 * spacing) / cube(side) * bytes);
}

void DepthField::evaluate(const DepthBatch& batch) const {
  if (form_.kind != DepthKind::grid) return evaluate_form(form_, batch);
  evaluate_grid(
      {origin_.x(), origin_.y(), origin_.z(), 1 / spacing_, blocks_[0], blocks_[1], blocks_[2], block_.data(),
       coefficient_.data(), plateau_, steepest_, edges_.block.empty() ? nullptr : &edges_},
      batch);
}

double DepthField::depth(const Vec3& x, Vec3* gradient) const {
  // a batch is evaluated four at a time
  double px[4], py[4], pz[4], depth[4], gx[4], gy[4], gz[4];
  std::fill(px, px + 4, x[0]);
  std::fill(py, py + 4, x[1]);
  std::fill(pz, pz + 4, x[2]);
  evaluate({px, py, pz, depth, gx, gy, gz, 4});
  const bool inside = depth[0] > 0;
  if (gradient) *gradient = inside ? Vec3(gx[0], gy[0], gz[0]) : Vec3(0, 0, 0);
  return inside ? depth[0] : 0.0;
}

std::size_t DepthField::near(const double* x, const double* y, const double* z, const double* radius,
                             std::size_t count, std::uint16_t* indices, double* apart) const {
  alignas(64) double bound[kChunk];
  const SphereBatch spheres{x, y, z, radius, count};
  assert(count <= kChunk);
  if (form_.kind != DepthKind::grid)
    bound_form(form_, spheres, bound);
  else
    bound_grid(
        {coarse_origin_.x(), coarse_origin_.y(), coarse_origin_.z(), coarse_spacing_, 1 / coarse_spacing_,
         box_centre_.x(), box_centre_.y(), box_centre_.z(), box_half_.x(), box_half_.y(), box_half_.z(),
         coarse_size_[0], coarse_size_[1], coarse_size_[2], coarse_.data()},
        spheres, bound);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {  // without a branch: which points are near is as good as random
    indices[found] = static_cast<std::uint16_t>(i);
    found += !(bound[i] > 0);
  }
  if (apart) *apart = found > 0 ? 0 : *std::min_element(bound, bound + count);
  return found;
}

std::size_t DepthField::bytes() const {
  return block_.size() * sizeof(std::int32_t) +
         (coefficient_.size() + coarse_.size() + edges_.coefficient.size()) * sizeof(float) +
         (edges_.first.size() + edges_.block.size()) * sizeof(std::int32_t);
}

}  // namespace packbed
