#include "contact/deep_points.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "math/simd.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr std::size_t kBatch = 128;      // points taken into the field at a time
constexpr std::size_t kRunOfClear = 16;  // listed points that are passed over at a time

typedef double v4d __attribute__((vector_size(32)));
typedef float v8f __attribute__((vector_size(32)));
typedef long long v4l __attribute__((vector_size(32)));

PACKBED_WIDE void move_points(const Sight& sight, const double* __restrict x, const double* __restrict y,
                              const double* __restrict z, std::size_t count, double* __restrict to_x,
                              double* __restrict to_y, double* __restrict to_z) {
  const std::array<double, 9> turn = sight.turn;  // copies: the stores below cannot change them
  const std::array<double, 3> shift = sight.shift;
  for (std::size_t i = 0; i < count; ++i) {
    to_x[i] = turn[0] * x[i] + turn[1] * y[i] + turn[2] * z[i] + shift[0];
    to_y[i] = turn[3] * x[i] + turn[4] * y[i] + turn[5] * z[i] + shift[1];
    to_z[i] = turn[6] * x[i] + turn[7] * y[i] + turn[8] * z[i] + shift[2];
  }
}

/// Sums over points in the frame of the field: four partial sums each, added at the end, so that any width of
/// vector gives the same bits. rate = w p d^(p - 1).
struct Sums {
  v4d power{}, rate{}, fx{}, fy{}, fz{}, tx{}, ty{}, tz{}, px{}, py{}, pz{}, xx{}, yy{}, zz{}, xy{}, yz{},
      zx{};
  v4d deepest{};
};

PACKBED_WIDE void add_up(const DeepPoints& p, std::size_t first, std::size_t last, Sums& s) {
  for (std::size_t i = first; i < last; i += 4) {
    v4d d, w, x, y, z, gx, gy, gz;
    std::memcpy(&d, &p.depth[i], sizeof d);
    std::memcpy(&w, &p.weight[i], sizeof w);
    std::memcpy(&x, &p.x[i], sizeof x);
    std::memcpy(&y, &p.y[i], sizeof y);
    std::memcpy(&z, &p.z[i], sizeof z);
    std::memcpy(&gx, &p.gx[i], sizeof gx);
    std::memcpy(&gy, &p.gy[i], sizeof gy);
    std::memcpy(&gz, &p.gz[i], sizeof gz);
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
    s.deepest = d > s.deepest ? d : s.deepest;
  }
}

double total(const v4d& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}
Vec3 total(const v4d& x, const v4d& y, const v4d& z) {
  return {total(x), total(y), total(z)};
}

/// Points on their way into the field.
struct Batch {
  alignas(64) double x[kBatch], y[kBatch], z[kBatch], weight[kBatch];
  alignas(64) double depth[kBatch], gx[kBatch], gy[kBatch], gz[kBatch];
  DepthBatch view(std::size_t count) { return {x, y, z, depth, gx, gy, gz, count}; }
};

std::size_t padded(std::size_t count) {
  return (count + 3) / 4 * 4;
}

/// Moves listed points into the frame of the field and asks it about them.
void take_in(const Sight& sight, std::span<const std::uint16_t> points, Batch& batch) {
  const SurfacePoints& p = sight.points->points;
  double x[kBatch], y[kBatch], z[kBatch];
  const std::size_t n = padded(points.size());
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = points[std::min(i, points.size() - 1)];
    x[i] = p.x[k];
    y[i] = p.y[k];
    z[i] = p.z[k];
    batch.weight[i] = p.weight[k];
  }
  move_points(sight, x, y, z, n, batch.x, batch.y, batch.z);
  sight.field->evaluate(batch.view(n));
}

void make_room(DeepPoints& deep, std::size_t more) {
  if (deep.size + more <= deep.x.size()) return;
  for (std::vector<double>* v :
       {&deep.x, &deep.y, &deep.z, &deep.weight, &deep.depth, &deep.gx, &deep.gy, &deep.gz})
    v->resize(2 * (deep.size + more));
}

/// A float no greater than x, which is not negative.
float below(double x) {
  return static_cast<float>(x * (1 - 1e-6));
}

/// Picks from the list, from entry `from` on, up to kBatch points that may be inside. Returns how many;
/// `from` goes on to the first entry that has not been asked.
PACKBED_WIDE std::size_t pick_due(const NearList& list, float travel, std::size_t& from,
                                  std::uint32_t* __restrict due) {
  const float* clear = list.clear.data();
  const std::size_t size = list.clear.size();
  std::size_t n = 0;
  for (; from < size && n + kRunOfClear <= kBatch; from += kRunOfClear) {
    v8f low, high;
    std::memcpy(&low, clear + from, sizeof low);
    std::memcpy(&high, clear + from + 8, sizeof high);
    const auto is_due = reinterpret_cast<v4l>((low <= travel) | (high <= travel));
    if (((is_due[0] | is_due[1]) | (is_due[2] | is_due[3])) == 0) continue;
    for (std::size_t i = from; i < from + kRunOfClear; ++i) {  // without a branch, which would be random
      due[n] = static_cast<std::uint32_t>(i);
      n += clear[i] <= travel;
    }
  }
  return n;
}

/// Appends point i of the batch to the last run.
void take_over(DeepPoints& deep, const Batch& batch, std::size_t i) {
  const std::size_t k = deep.size++;
  deep.x[k] = batch.x[i];
  deep.y[k] = batch.y[i];
  deep.z[k] = batch.z[i];
  deep.weight[k] = batch.weight[i];
  deep.depth[k] = batch.depth[i];
  deep.gx[k] = batch.gx[i];
  deep.gy[k] = batch.gy[i];
  deep.gz[k] = batch.gz[i];
  std::size_t& top = deep.runs.back().top;
  if (deep.depth[k] > deep.depth[top]) top = k;
}

/// Pads the last run with its last point, without weight.
void end_run(DeepPoints& deep) {
  if (deep.runs.empty()) return;
  make_room(deep, 4);
  const std::size_t last = deep.size - 1;
  for (; deep.size % 4 != 0; ++deep.size) {
    for (std::vector<double>* v : {&deep.x, &deep.y, &deep.z, &deep.depth, &deep.gx, &deep.gy, &deep.gz})
      (*v)[deep.size] = (*v)[last];
    deep.weight[deep.size] = 0;
  }
  deep.runs.back().last = deep.size;
}

}  // namespace

Sight sight(const FieldPellet& points, const DepthField& field, const Pose& field_pose, double field_scale,
            double sign) {
  Sight s;
  s.points = points.body;
  s.field = &field;
  s.field_turn = field_pose.rotation.toRotationMatrix();
  s.field_centre = field_pose.position;
  s.field_scale = field_scale;
  s.point_scale = points.scale;
  s.sign = sign;
  const Mat3 back = s.field_turn.transpose();
  const Mat3 turn = (points.scale / field_scale) * back * points.pose.rotation.toRotationMatrix();
  const Vec3 shift = back * (points.pose.position - field_pose.position) / field_scale;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) s.turn[static_cast<std::size_t>(3 * i + j)] = turn(i, j);
    s.shift[static_cast<std::size_t>(i)] = shift[i];
  }
  return s;
}

double list_near(const Sight& sight, double margin, NearList& list) {
  list.drop();
  const SurfacePoints& p = sight.points->points;
  constexpr std::size_t kChunk = DepthField::kChunk;
  alignas(64) double x[kChunk], y[kChunk], z[kChunk], radius[kChunk];
  std::uint16_t cluster[kChunk];
  const double scale = sight.point_scale / sight.field_scale, reach = margin / sight.field_scale;
  double apart = kForever;
  bool any = false;
  for (std::size_t first = 0; first < p.clusters(); first += kChunk) {
    const std::size_t n = std::min(kChunk, p.clusters() - first);
    move_points(sight, &p.cluster_x[first], &p.cluster_y[first], &p.cluster_z[first], n, x, y, z);
    for (std::size_t i = 0; i < n; ++i) radius[i] = p.cluster_radius[first + i] * scale + reach;
    double chunk_apart = 0;
    const std::size_t found = sight.field->near(x, y, z, radius, n, cluster, &chunk_apart);
    if (found == 0) apart = std::min(apart, chunk_apart + reach);
    for (std::size_t c = 0; c < found; ++c) {
      std::array<std::uint16_t, kCluster> all;
      std::size_t size = 0;
      for (std::size_t k = 0; k < kCluster; ++k) {
        const std::size_t i = (first + cluster[c]) * kCluster + k;
        if (p.weight[i] > 0) all[size++] = static_cast<std::uint16_t>(i);
      }
      Batch batch;
      take_in(sight, {all.data(), size}, batch);
      for (std::size_t k = 0; k < size; ++k) {
        if (batch.depth[k] < -reach) continue;
        list.index.push_back(all[k]);
        list.clear.push_back(below(std::max(0.0, -batch.depth[k] * sight.field_scale)));
      }
      any = true;
    }
  }
  while (list.index.size() % kRunOfClear != 0) {
    list.index.push_back(0);
    list.clear.push_back(std::numeric_limits<float>::infinity());
  }
  return (any ? reach : apart) * sight.field_scale;
}

void find_deep(const Sight& sight, double travel, NearList& list, DeepPoints& deep) {
  deep.clear();
  std::size_t cluster = 0;
  Batch batch;
  std::array<std::uint32_t, kBatch> due;
  std::array<std::uint16_t, kBatch> points;
  for (std::size_t from = 0; from < list.index.size();) {
    const std::size_t n = pick_due(list, static_cast<float>(travel), from, due.data());
    if (n == 0) continue;
    for (std::size_t i = 0; i < n; ++i) points[i] = list.index[due[i]];
    take_in(sight, {points.data(), n}, batch);
    make_room(deep, 4 * n);
    for (std::size_t i = 0; i < n; ++i) {
      const double depth = batch.depth[i];
      list.clear[due[i]] = below(travel + std::max(0.0, -depth * sight.field_scale));
      if (!(depth > 0)) continue;
      const std::size_t of = points[i] / kCluster;
      if (deep.runs.empty() || of != cluster) {
        end_run(deep);
        deep.runs.push_back({deep.size, deep.size, deep.size});
        cluster = of;
      }
      take_over(deep, batch, i);
    }
  }
  end_run(deep);
}

double clear_of_all(const NearList& list) {
  double least = kForever;
  for (const float clear : list.clear) least = std::min(least, static_cast<double>(clear));
  return least;
}

void add_deep(const Sight& sight, const DeepPoints& deep, std::span<const std::uint8_t> patch,
              std::uint8_t which, const Vec3& origin, TouchSum<kPointExponent>& sum) {
  Sums s;
  bool any = false;
  for (std::size_t r = 0; r < deep.runs.size(); ++r) {
    if (!patch.empty() && patch[r] != which) continue;
    add_up(deep, deep.runs[r].first, deep.runs[r].last, s);
    any = true;
  }
  if (!any) return;
  // weights are lengths of the points' body, depths and places lengths of the field's
  const double s1 = sight.field_scale, s2 = s1 * s1;
  const double slope = sight.point_scale * depth_power_slope<kPointExponent>(s1) / kPointExponent;
  const Mat3& turn = sight.field_turn;
  const Vec3 centre = sight.field_centre - origin;
  const double rate = slope * total(s.rate);
  const Vec3 force = slope * (turn * total(s.fx, s.fy, s.fz));
  const Vec3 turning = slope * s1 * (turn * total(s.tx, s.ty, s.tz));
  const Vec3 place = slope * s1 * (turn * total(s.px, s.py, s.pz));
  const Vec3 square = total(s.xx, s.yy, s.zz), mixed = total(s.xy, s.yz, s.zx);
  Mat3 own;
  own << square.x(), mixed.x(), mixed.z(), mixed.x(), square.y(), mixed.y(), mixed.z(), mixed.y(), square.z();
  const Mat3 shifted = centre * place.transpose();
  const Mat3 second = slope * s2 * (turn * own * turn.transpose()) + shifted + shifted.transpose() +
                      rate * centre * centre.transpose();
  const double deepest = std::max({s.deepest[0], s.deepest[1], s.deepest[2], s.deepest[3]});
  sum.add_sums(sight.point_scale * depth_power<kPointExponent>(s1) * total(s.power), sight.sign * force,
               sight.sign * (turning + centre.cross(force)), {rate, place + rate * centre, second},
               s1 * deepest);
}

}  // namespace packbed
