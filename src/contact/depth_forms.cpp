#include "contact/depth_forms.hpp"

#include <algorithm>
#include <cmath>

#include "math/simd.hpp"

namespace packbed {
namespace {

constexpr double kTiny = 1e-300;  // keeps quotients finite where nothing is inside

PACKBED_WIDE void sphere_depth(double radius, const DepthBatch& b) {
  const double* __restrict x = b.x, * __restrict y = b.y, * __restrict z = b.z;
  double* __restrict depth = b.depth, * __restrict gx = b.gx, * __restrict gy = b.gy, * __restrict gz = b.gz;
  const double per_radius = 1 / radius;
  for (std::size_t i = 0; i < b.count; ++i) {
    const double r2 = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    const double d = 0.5 * (radius - r2 * per_radius), out = radius - std::sqrt(r2);
    depth[i] = d > 0 ? d : (out < 0 ? out : 0.0);
    gx[i] = -x[i] * per_radius;
    gy[i] = -y[i] * per_radius;
    gz[i] = -z[i] * per_radius;
  }
}

PACKBED_WIDE void cylinder_depth(double radius, double half_height, const DepthBatch& batch) {
  const double* __restrict x = batch.x, * __restrict y = batch.y, * __restrict z = batch.z;
  double *__restrict depth = batch.depth, *__restrict gx = batch.gx, *__restrict gy = batch.gy,
                     *__restrict gz = batch.gz;
  const double per_radius = 1 / radius, per_height = 1 / half_height;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const double rho2 = x[i] * x[i] + y[i] * y[i];
    const double a = 0.5 * (radius - rho2 * per_radius), b = 0.5 * (half_height - z[i] * z[i] * per_height);
    const double norm = std::sqrt(a * a + b * b) + kTiny;
    const double across = radius - std::sqrt(rho2), along = half_height - std::abs(z[i]);
    const double out = across < along ? across : along;
    const bool in = (a > 0) & (b > 0);
    depth[i] = in ? a + b - norm : (out < 0 ? out : 0.0);
    const double by_a = (1 - a / norm) * per_radius;
    gx[i] = -x[i] * by_a;
    gy[i] = -y[i] * by_a;
    gz[i] = -z[i] * (1 - b / norm) * per_height;
  }
}

/// How far points are inside, at most, and outside, at least: the nearest of the faces, negative outside.
PACKBED_WIDE void tube_clearance(double radius, double inner_radius, double half_height,
                                 const DepthBatch& batch) {
  const double* __restrict x = batch.x, * __restrict y = batch.y, * __restrict z = batch.z;
  double* __restrict depth = batch.depth;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const double rho = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    const double outer = radius - rho, inner = rho - inner_radius, along = half_height - std::abs(z[i]);
    const double across = outer < inner ? outer : inner;
    depth[i] = across < along ? across : along;
  }
}

/// Of points inside.
PACKBED_WIDE void tube_depth(double radius, double inner_radius, double half_height,
                             const DepthBatch& batch) {
  const double* __restrict x = batch.x, * __restrict y = batch.y, * __restrict z = batch.z;
  double *__restrict depth = batch.depth, *__restrict gx = batch.gx, *__restrict gy = batch.gy,
                     *__restrict gz = batch.gz;
  const double per_radius = 1 / radius, per_inner = 1 / inner_radius, per_height = 1 / half_height;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const double rho2 = x[i] * x[i] + y[i] * y[i];
    const double a = 0.5 * (radius - rho2 * per_radius), c = 0.5 * (rho2 * per_inner - inner_radius);
    const double b = 0.5 * (half_height - z[i] * z[i] * per_height);
    const double a3 = a * a * a, c3 = c * c * c, b3 = b * b * b;
    const double in_wall = std::sqrt(std::sqrt(a3 * a + c3 * c)) + kTiny, wall = a + c - in_wall;
    const double wall3 = wall * wall * wall, norm = std::sqrt(std::sqrt(wall3 * wall + b3 * b)) + kTiny;
    depth[i] = wall + b - norm;
    const double per_wall = 1 / (in_wall * in_wall * in_wall + kTiny),
                 per_norm = 1 / (norm * norm * norm + kTiny);
    const double by_wall = 1 - wall3 * per_norm;
    const double by_rho = by_wall * ((1 - c3 * per_wall) * per_inner - (1 - a3 * per_wall) * per_radius);
    gx[i] = x[i] * by_rho;
    gy[i] = y[i] * by_rho;
    gz[i] = -z[i] * (1 - b3 * per_norm) * per_height;
  }
}

PACKBED_WIDE void planes_clearance(const DepthForm& form, const DepthBatch& batch) {
  const double* __restrict x = batch.x, * __restrict y = batch.y, * __restrict z = batch.z;
  double* __restrict least = batch.depth;
  std::fill(least, least + batch.count, 1e300);
  for (std::size_t k = 0; k < form.offset.size(); ++k) {
    const double nx = form.nx[k], ny = form.ny[k], nz = form.nz[k], offset = form.offset[k];
    for (std::size_t i = 0; i < batch.count; ++i) {
      const double d = offset - nx * x[i] - ny * y[i] - nz * z[i];
      least[i] = d < least[i] ? d : least[i];
    }
  }
}

/// Of points inside.
PACKBED_WIDE void planes_depth(const DepthForm& form, const DepthBatch& batch) {
  constexpr std::size_t kSide = 4;  // points that planes are held against together
  for (std::size_t i = 0; i < batch.count; i += kSide) {
    double sum[kSide] = {}, sx[kSide] = {}, sy[kSide] = {}, sz[kSide] = {};
    for (std::size_t k = 0; k < form.offset.size(); ++k)
      for (std::size_t l = 0; l < kSide; ++l) {
        const double d = form.offset[k] - form.nx[k] * batch.x[i + l] - form.ny[k] * batch.y[i + l] -
                         form.nz[k] * batch.z[i + l];
        const double per = 1 / (d > 1e-30 ? d : 1e-30), per2 = per * per, per4 = per2 * per2;
        sum[l] += per4;
        sx[l] += per4 * per * form.nx[k];
        sy[l] += per4 * per * form.ny[k];
        sz[l] += per4 * per * form.nz[k];
      }
    for (std::size_t l = 0; l < kSide; ++l) {
      const double d = 1 / std::sqrt(std::sqrt(sum[l])), d2 = d * d, slope = -d2 * d2 * d;
      batch.depth[i + l] = d;
      batch.gx[i + l] = slope * sx[l];
      batch.gy[i + l] = slope * sy[l];
      batch.gz[i + l] = slope * sz[l];
    }
  }
}

/// Few points of a batch are inside, and only those need the whole form: clearance(batch) of all, then
/// depth(batch) of those alone.
template <class Clearance, class Depth>
void evaluate_inside(const DepthBatch& batch, const Clearance& clearance, const Depth& depth) {
  constexpr std::size_t kMost = 64;
  double x[kMost], y[kMost], z[kMost], d[kMost], gx[kMost], gy[kMost], gz[kMost];
  std::size_t index[kMost], size = 0;
  const auto finish = [&] {
    if (size == 0) return;
    std::size_t padded = size;
    for (; padded % 4 != 0; ++padded) x[padded] = x[0], y[padded] = y[0], z[padded] = z[0];
    depth(DepthBatch{x, y, z, d, gx, gy, gz, padded});
    for (std::size_t k = 0; k < size; ++k) {
      batch.depth[index[k]] = d[k];
      batch.gx[index[k]] = gx[k];
      batch.gy[index[k]] = gy[k];
      batch.gz[index[k]] = gz[k];
    }
    size = 0;
  };
  clearance(batch);
  for (std::size_t i = 0; i < batch.count; ++i) {
    if (!(batch.depth[i] > 0)) continue;
    index[size] = i;
    x[size] = batch.x[i];
    y[size] = batch.y[i];
    z[size++] = batch.z[i];
    if (size == kMost) finish();
  }
  finish();
}

void floor_depth(const DepthBatch& b) {
  for (std::size_t i = 0; i < b.count; ++i) {
    b.depth[i] = -b.z[i];
    b.gx[i] = b.gy[i] = 0;
    b.gz[i] = -1;
  }
}

PACKBED_WIDE void bore_depth(double tube, const DepthBatch& b) {
  const double* __restrict x = b.x, * __restrict y = b.y;
  double* __restrict depth = b.depth, * __restrict gx = b.gx, * __restrict gy = b.gy, * __restrict gz = b.gz;
  const double per_tube = 1 / tube;
  for (std::size_t i = 0; i < b.count; ++i) {
    const double rho2 = x[i] * x[i] + y[i] * y[i], out = std::sqrt(rho2) - tube;
    const double d = 0.5 * (rho2 * per_tube - tube);
    depth[i] = d > 0 ? d : (out < 0 ? out : 0.0);
    gx[i] = x[i] * per_tube;
    gy[i] = y[i] * per_tube;
    gz[i] = 0;
  }
}

}  // namespace

void evaluate_form(const DepthForm& form, const DepthBatch& batch) {
  switch (form.kind) {
    case DepthKind::sphere:
      return sphere_depth(form.radius, batch);
    case DepthKind::cylinder:
      return cylinder_depth(form.radius, form.half_height, batch);
    case DepthKind::tube:
      return evaluate_inside(
          batch,
          [&](const DepthBatch& b) { tube_clearance(form.radius, form.inner_radius, form.half_height, b); },
          [&](const DepthBatch& b) { tube_depth(form.radius, form.inner_radius, form.half_height, b); });
    case DepthKind::planes:
      return evaluate_inside(
          batch, [&](const DepthBatch& b) { planes_clearance(form, b); },
          [&](const DepthBatch& b) { planes_depth(form, b); });
    case DepthKind::floor:
      return floor_depth(batch);
    case DepthKind::bore:
      return bore_depth(form.radius, batch);
    case DepthKind::grid:
      break;
  }
}

void bound_form(const DepthForm& form, const SphereBatch& spheres, double* bound) {
  // outside of a body the depth of the centre is minus a bound of its distance; inside it is positive
  const DepthBatch centres{spheres.x, spheres.y, spheres.z, bound, nullptr, nullptr, nullptr, spheres.count};
  switch (form.kind) {
    case DepthKind::tube:
    case DepthKind::cylinder:
      tube_clearance(form.radius, form.inner_radius, form.half_height, centres);
      break;
    case DepthKind::planes:
      planes_clearance(form, centres);
      break;
    case DepthKind::sphere:
      for (std::size_t i = 0; i < spheres.count; ++i)
        bound[i] = form.radius - Vec3(spheres.x[i], spheres.y[i], spheres.z[i]).norm();
      break;
    case DepthKind::floor:
      for (std::size_t i = 0; i < spheres.count; ++i) bound[i] = -spheres.z[i];
      break;
    case DepthKind::bore:
      for (std::size_t i = 0; i < spheres.count; ++i)
        bound[i] = std::sqrt(spheres.x[i] * spheres.x[i] + spheres.y[i] * spheres.y[i]) - form.radius;
      break;
    case DepthKind::grid:
      break;
  }
  for (std::size_t i = 0; i < spheres.count; ++i) bound[i] = -bound[i] - spheres.radius[i];
}

}  // namespace packbed
