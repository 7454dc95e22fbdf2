#include "contact/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "math/error.hpp"
#include "math/simd.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostClusters = 4096;  // of one body; more would be a spacing far too fine for its size
constexpr std::size_t kBatch = 128;          // points taken into the field at a time

typedef double v4d __attribute__((vector_size(32)));

/// From the frame of one body to that of another: x -> turn x + shift, in the other's unscaled lengths.
struct Map {
  double turn[9];
  double shift[3];
};

PACKBED_WIDE void move_points(const Map& map, const double* __restrict x, const double* __restrict y,
                              const double* __restrict z, std::size_t count, double* __restrict to_x,
                              double* __restrict to_y, double* __restrict to_z) {
  const Map m = map;  // a copy: the stores below cannot change it
  for (std::size_t i = 0; i < count; ++i) {
    to_x[i] = m.turn[0] * x[i] + m.turn[1] * y[i] + m.turn[2] * z[i] + m.shift[0];
    to_y[i] = m.turn[3] * x[i] + m.turn[4] * y[i] + m.turn[5] * z[i] + m.shift[1];
    to_z[i] = m.turn[6] * x[i] + m.turn[7] * y[i] + m.turn[8] * z[i] + m.shift[2];
  }
}

/// Points in the frame of the field, waiting or evaluated.
struct Batch {
  alignas(64) double x[kBatch], y[kBatch], z[kBatch], weight[kBatch];
  alignas(64) double depth[kBatch], gx[kBatch], gy[kBatch], gz[kBatch];
  std::size_t size = 0;
};

/// Sums over points in the frame of the field: four partial sums each, added at the end, so that any width of
/// vector gives the same bits. rate = w p d^(p - 1).
struct Sums {
  v4d power{}, rate{}, fx{}, fy{}, fz{}, tx{}, ty{}, tz{}, px{}, py{}, pz{}, xx{}, yy{}, zz{}, xy{}, yz{},
      zx{};
  double deepest = 0;
};

PACKBED_WIDE void add_batch(const Batch& b, Sums& s) {
  v4d deepest{};
  for (std::size_t i = 0; i < b.size; i += 4) {
    v4d d, w, x, y, z, gx, gy, gz;
    std::memcpy(&d, b.depth + i, sizeof d);
    std::memcpy(&w, b.weight + i, sizeof w);
    std::memcpy(&x, b.x + i, sizeof x);
    std::memcpy(&y, b.y + i, sizeof y);
    std::memcpy(&z, b.z + i, sizeof z);
    std::memcpy(&gx, b.gx + i, sizeof gx);
    std::memcpy(&gy, b.gy + i, sizeof gy);
    std::memcpy(&gz, b.gz + i, sizeof gz);
    const v4d rate = w * depth_power_slope<kPointExponent>(d);
    const v4d fx = rate * gx, fy = rate * gy, fz = rate * gz;
    s.power += w * depth_power<kPointExponent>(d);
    s.rate += rate;
    s.fx += fx;
    s.fy += fy;
    s.fz += fz;
    s.tx += y * fz - z * fy;
    s.ty += z * fx - x * fz;
    s.tz += x * fy - y * fx;
    s.px += rate * x;
    s.py += rate * y;
    s.pz += rate * z;
    s.xx += rate * x * x;
    s.yy += rate * y * y;
    s.zz += rate * z * z;
    s.xy += rate * x * y;
    s.yz += rate * y * z;
    s.zx += rate * z * x;
    deepest = d > deepest ? d : deepest;
  }
  s.deepest = std::max({s.deepest, deepest[0], deepest[1], deepest[2], deepest[3]});
}

void flush(const DepthField& field, Batch& batch, Sums& sums) {
  for (; batch.size % 4 != 0; ++batch.size) {
    batch.x[batch.size] = batch.x[0];
    batch.y[batch.size] = batch.y[0];
    batch.z[batch.size] = batch.z[0];
    batch.weight[batch.size] = 0;
  }
  field.evaluate({batch.x, batch.y, batch.z, batch.depth, batch.gx, batch.gy, batch.gz, batch.size});
  add_batch(batch, sums);
  batch.size = 0;
}

/// The clusters of a body that may reach into a field, and how to get there.
struct Reach {
  Map map;
  std::size_t count = 0;
  std::uint16_t cluster[kMostClusters];
};

Map map_between(const FieldPellet& from, const Pose& to, double to_scale) {
  const Mat3 back = to.rotation.toRotationMatrix().transpose();
  const Mat3 turn = (from.scale / to_scale) * back * from.pose.rotation.toRotationMatrix();
  const Vec3 shift = back * (from.pose.position - to.position) / to_scale;
  Map map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) map.turn[3 * i + j] = turn(i, j);
    map.shift[i] = shift[i];
  }
  return map;
}

/// Returns a lower bound of the distance of the points from the field's body when no cluster reaches it, else
/// 0.
double find_clusters(const FieldPellet& from, const DepthField& field, double field_scale, Reach& reach) {
  const SurfacePoints& p = from.body->points;
  constexpr std::size_t kChunk = DepthField::kChunk;
  alignas(64) double x[kChunk], y[kChunk], z[kChunk], radius[kChunk];
  double apart = kForever;
  reach.count = 0;
  for (std::size_t first = 0; first < p.clusters(); first += kChunk) {
    const std::size_t n = std::min(kChunk, p.clusters() - first);
    move_points(reach.map, &p.cluster_x[first], &p.cluster_y[first], &p.cluster_z[first], n, x, y, z);
    const double scale = from.scale / field_scale;
    for (std::size_t i = 0; i < n; ++i) radius[i] = p.cluster_radius[first + i] * scale;
    double chunk_apart = 0;
    const std::size_t found = field.near(x, y, z, radius, n, reach.cluster + reach.count, &chunk_apart);
    apart = std::min(apart, chunk_apart);
    for (std::size_t i = reach.count; i < reach.count + found; ++i)
      reach.cluster[i] = static_cast<std::uint16_t>(reach.cluster[i] + first);
    reach.count += found;
  }
  return apart * field_scale;
}

Sums sum_clusters(const FieldPellet& from, const DepthField& field, const Reach& reach) {
  const SurfacePoints& p = from.body->points;
  static constexpr double kPoint[kCluster] = {};  // points have no radius
  Sums sums;
  Batch batch;
  for (std::size_t c = 0; c < reach.count; ++c) {
    const std::size_t first = reach.cluster[c] * kCluster;
    alignas(64) double x[kCluster], y[kCluster], z[kCluster];
    std::uint16_t index[kCluster];
    move_points(reach.map, &p.x[first], &p.y[first], &p.z[first], kCluster, x, y, z);
    const std::size_t found = field.near(x, y, z, kPoint, kCluster, index);
    for (std::size_t k = 0; k < found; ++k) {
      batch.x[batch.size] = x[index[k]];
      batch.y[batch.size] = y[index[k]];
      batch.z[batch.size] = z[index[k]];
      batch.weight[batch.size++] = p.weight[first + index[k]];
    }
    if (batch.size + kCluster > kBatch) flush(field, batch, sums);
  }
  if (batch.size > 0) flush(field, batch, sums);
  return sums;
}

double total(const v4d& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}
Vec3 total(const v4d& x, const v4d& y, const v4d& z) {
  return {total(x), total(y), total(z)};
}

/// From the frame of the field (turned by `turn`, at `centre` from the origin of `out`) to the world. `sign`:
/// +1 when the points are a's, -1 when the field is.
void add_to(TouchSum<kPointExponent>& out, const Sums& s, const Quat& rotation, const Vec3& centre,
            double field_scale, double point_scale, double sign) {
  // weights are lengths of the points' body, depths and places lengths of the field's
  const Mat3 turn = rotation.toRotationMatrix();
  const double s2 = field_scale * field_scale,
               slope = depth_power_slope<kPointExponent>(field_scale) / kPointExponent;
  const double rate = point_scale * slope * total(s.rate);
  const Vec3 force = point_scale * slope * (turn * total(s.fx, s.fy, s.fz));
  const Vec3 turning = point_scale * slope * field_scale * (turn * total(s.tx, s.ty, s.tz));
  const Vec3 place = point_scale * slope * field_scale * (turn * total(s.px, s.py, s.pz));
  const Vec3 square = total(s.xx, s.yy, s.zz), mixed = total(s.xy, s.yz, s.zx);
  Mat3 own;
  own << square.x(), mixed.x(), mixed.z(), mixed.x(), square.y(), mixed.y(), mixed.z(), mixed.y(), square.z();
  const Mat3 shifted = centre * place.transpose();
  const Mat3 second = point_scale * slope * s2 * (turn * own * turn.transpose()) + shifted +
                      shifted.transpose() + rate * centre * centre.transpose();
  out.add_sums(point_scale * depth_power<kPointExponent>(field_scale) * total(s.power), sign * force,
               sign * (turning + centre.cross(force)), {rate, place + rate * centre, second},
               field_scale * s.deepest);
}

}  // namespace

FieldBody make_field_body(const Shape& shape, const FieldOptions& options) {
  const double diameter = 2 * std::cbrt(3 * shape.volume / (4 * kPi));
  const double spacing = options.spacing > 0 ? options.spacing : diameter / kPointsAcross;
  const double grid =
      options.grid > 0 ? options.grid : std::min(diameter / kGridAcross, shape.smallest_thickness / 8);
  const auto make_field = [&] {
    if (shape.kind == ShapeClass::sphere) return DepthField::of_sphere(shape.radius);
    if (shape.kind == ShapeClass::cylinder) return DepthField::of_cylinder(shape.radius, shape.half_height);
    return DepthField::of_mesh(shape.surface, grid);
  };
  FieldBody body{sample_surface(shape, spacing), make_field(), size_radius(shape), shape.bounding_radius,
                 0.4 * shape.smallest_thickness};
  if (body.points.clusters() > kMostClusters)
    throw InputError(
        "shape " + shape.name,
        fmt::format("{} surface points at a spacing of {:.4g} mm", body.points.size(), spacing * 1e3),
        fmt::format("at most {}", kMostClusters * kCluster), "take a wider spacing of surface points");
  return body;
}

Touch touch_field(const FieldPellet& a, const FieldPellet& b, double* gap) {
  const double reach_a = a.body->reach * a.scale, reach_b = b.body->reach * b.scale;
  const Vec3 apart = a.pose.position - b.pose.position;
  const double distance2 = apart.squaredNorm();
  if (gap) *gap = std::max(0.0, std::sqrt(distance2) - reach_a - reach_b);
  if (distance2 >= (reach_a + reach_b) * (reach_a + reach_b)) return {};

  // Points of a in b, and of b in a. When a's points are so far from b that no part of its surface between
  // them can be in b, none of b's can be in a.
  Reach reach_in_b, reach_in_a;
  reach_in_b.map = map_between(a, b.pose, b.scale);
  const double clear_a = find_clusters(a, b.body->field, b.scale, reach_in_b),
               cover = a.body->points.cover * a.scale;
  if (clear_a > cover) {
    if (gap) *gap = std::max(*gap, clear_a - cover);
    return {};
  }
  reach_in_a.map = map_between(b, a.pose, a.scale);
  const double clear_b = find_clusters(b, a.body->field, a.scale, reach_in_a);
  if (gap) *gap = std::max(*gap, std::min(clear_a, clear_b));
  const Vec3 origin = b.pose.position + 0.5 * apart;
  TouchSum<kPointExponent> sum(origin);
  if (reach_in_b.count > 0)
    add_to(sum, sum_clusters(a, b.body->field, reach_in_b), b.pose.rotation, b.pose.position - origin,
           b.scale, a.scale, 1);
  if (reach_in_a.count > 0)
    add_to(sum, sum_clusters(b, a.body->field, reach_in_a), a.pose.rotation, a.pose.position - origin,
           a.scale, b.scale, -1);
  const double size = std::min(a.body->size * a.scale, b.body->size * b.scale);
  return sum.finish(2 * kPi * size, a.pose.position - origin, b.pose.position - origin);
}

FieldWall make_field_wall(const Container& container, double thickness, double limit_bytes) {
  // as deep as a pellet could ever be pressed in, and a few cells of it
  const double deepest = 0.25 * thickness;
  double spacing = thickness / 8;
  const double coarsest = thickness / 2.5;
  while (DepthField::estimate_bytes(container.surface, spacing, deepest) > limit_bytes && spacing < coarsest)
    spacing = std::min(coarsest, spacing * 1.1);
  const double bytes = DepthField::estimate_bytes(container.surface, spacing, deepest);
  if (bytes > limit_bytes)
    throw InputError(
        "container " + container.name,
        fmt::format("a wall whose depth field needs {:.0f} MB at the coarsest grid that still holds these "
                    "pellets ({:.3g} mm)",
                    bytes / 1e6, spacing * 1e3),
        fmt::format("{:.0f} MB", limit_bytes / 1e6),
        "raise the memory limit, or cut away what the bed never touches");
  return {DepthField::of_mesh(container.surface, spacing, deepest), 0.95 * deepest};
}

Touch touch_container(const FieldPellet& a, const FieldWall& wall, double* gap) {
  const Pose still;  // the wall stays where it was read
  Reach reach;
  reach.map = map_between(a, still, 1);
  const double clear = find_clusters(a, wall.field, 1, reach);
  if (gap) *gap = clear;
  if (reach.count == 0) return {};
  TouchSum<kPointExponent> sum(a.pose.position);
  add_to(sum, sum_clusters(a, wall.field, reach), still.rotation, -a.pose.position, 1, a.scale, 1);
  return sum.finish(2 * kPi * a.body->size * a.scale, Vec3::Zero(), -a.pose.position);
}

}  // namespace packbed
