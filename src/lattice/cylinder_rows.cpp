#include "lattice/cylinder_rows.hpp"

#include <algorithm>
#include <cmath>

#include "math/simd.hpp"

namespace packbed {
namespace {

constexpr int kLane = RowIntervals::kLane;

/// A cylinder as its rows see it. The side meets a row at the distances from its centre where
/// A x^2 - 2 a_x s x + dy^2 + dz^2 - s^2 - r^2 = 0, with A = a_y^2 + a_z^2 and s = a_y dy + a_z dz; a quarter
/// of the discriminant is A r^2 - (a_z dy - a_y dz)^2. The caps meet it where |a_x x + s| = h.
struct CylinderRows {
  CylinderRows(const Vec3& axis, double r, double h, double centre, double length)
      : ax(axis.x()), ay(axis.y()), az(axis.z()), half_height(h), middle(centre), limit(length) {
    const double across = ay * ay + az * az;
    along_x = across < 1e-18;
    flat_x = std::abs(ax) < 1e-12;
    inv_across = along_x ? 0 : 1 / across;
    inv_ax = flat_x ? 0 : 1 / ax;
    radius2 = r * r;
    across_r2 = across * radius2;
  }
  double ax, ay, az;  // axis
  double half_height, radius2;
  double middle, limit;  // centre and length of a row, both from its first cell
  double across_r2, inv_across, inv_ax;
  bool along_x, flat_x;
};

/// Cells [from, to) that a row has inside the cylinder. dy, dz: of the row from the centre.
struct RowInterval {
  double from, to;
};
RowInterval cylinder_row(const CylinderRows& c, double dy, double dz) {
  const double s = c.ay * dy + c.az * dz, b = c.ax * s, t = c.az * dy - c.ay * dz;
  const double discriminant = c.along_x ? c.radius2 - dy * dy - dz * dz : c.across_r2 - t * t;
  if (discriminant < 0 || (c.flat_x && std::abs(s) > c.half_height)) return {0, 0};
  double low = -c.limit, high = c.limit;
  if (!c.along_x) {
    const double root = std::sqrt(discriminant);
    low = (b - root) * c.inv_across;
    high = (b + root) * c.inv_across;
  }
  if (!c.flat_x) {
    const double p = (-c.half_height - s) * c.inv_ax, r = (c.half_height - s) * c.inv_ax;
    low = std::max(low, std::min(p, r));
    high = std::min(high, std::max(p, r));
  }
  return {std::ceil(std::clamp(c.middle + low, 0.0, c.limit)),
          std::ceil(std::clamp(c.middle + high, 0.0, c.limit))};
}

/// The same for `n` rows, whole lanes, from dy0 upwards, where the axis is neither along x nor square to it.
/// Written so that it vectorises: no branch, and selections one at a time.
PACKBED_WIDE void cylinder_rows(const CylinderRows& c, double dy0, double dz, int n,
                                std::int32_t* __restrict from, std::int32_t* __restrict to) {
  const double ay = c.ay, sz = c.az * dz, az = c.az, tz = c.ay * dz, slope = c.ax * c.inv_across,
               across_r2 = c.across_r2, inv_across = c.inv_across, inv_ax = c.inv_ax, middle = c.middle,
               limit = c.limit, cap = std::abs(c.half_height * c.inv_ax);
  for (int j = 0; j < n / kLane * kLane; ++j) {
    const double dy = dy0 + j, s = ay * dy + sz, t = az * dy - tz;
    const double discriminant = across_r2 - t * t;
    const double half = std::sqrt(discriminant > 0 ? discriminant : 0.0) * inv_across;
    const double lateral = middle + slope * s, caps = middle - s * inv_ax;
    const double lateral_low = lateral - half, lateral_high = lateral + half, cap_low = caps - cap,
                 cap_high = caps + cap;
    const double low = lateral_low < cap_low ? cap_low : lateral_low;
    const double high = cap_high < lateral_high ? cap_high : lateral_high;
    const double begin = low < 0 ? 0 : limit < low ? limit : low;
    const double end = high < 0 ? 0 : limit < high ? limit : high;
    const bool hit = discriminant >= 0;
    from[j] = hit ? static_cast<std::int32_t>(std::ceil(begin)) : 0;
    to[j] = hit ? static_cast<std::int32_t>(std::ceil(end)) : 0;
  }
}

/// Rows [first, first + n) of a slice that the side may reach, whole lanes of the `whole` rows there are.
struct Reach {
  int first, n;
};
Reach reach_of_side(const CylinderRows& c, double dy0, double dz, int whole) {
  const double inverse = 1 / (std::abs(c.az) + 1e-30), tz = c.az < 0 ? -c.ay * dz : c.ay * dz,
               half = std::sqrt(c.across_r2);
  const double low = std::clamp((tz - half) * inverse - dy0 - 1, 0.0, static_cast<double>(whole));
  const double high = std::clamp((tz + half) * inverse - dy0 + 2, low, static_cast<double>(whole));
  const int first = static_cast<int>(low), n = (static_cast<int>(high) - first + kLane - 1) / kLane * kLane;
  return {std::min(first, whole - n), n};
}

}  // namespace

Vec3 reach_of_cylinder(const Vec3& axis, double radius, double half_height) {
  return radius * (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0).cwiseSqrt() + half_height * axis.cwiseAbs();
}

void cylinder_intervals(const Vec3& centre, const Vec3& axis, double radius, double half_height, int length,
                        RowIntervals& out) {
  const CylinderRows rows(axis, radius, half_height, centre.x(), length);
  const int whole = out.stride() - RowIntervals::kMore;
  out.from.resize(out.at(out.box.nz));
  out.to.resize(out.from.size());
  for (int k = 0; k < out.box.nz; ++k) {
    const double dy0 = out.box.y - centre.y(), dz = out.box.z + k - centre.z();
    std::int32_t *from = out.from.data() + out.at(k), *to = out.to.data() + out.at(k);
    std::fill(from, from + out.stride(), 0);
    std::fill(to, to + out.stride(), 0);
    if (!rows.along_x && !rows.flat_x) {
      const Reach reach = reach_of_side(rows, dy0, dz, whole);
      cylinder_rows(rows, dy0 + reach.first, dz, reach.n, from + reach.first, to + reach.first);
      continue;
    }
    for (int j = 0; j < whole; ++j) {
      const RowInterval r = cylinder_row(rows, dy0 + j, dz);
      from[j] = static_cast<std::int32_t>(r.from);
      to[j] = static_cast<std::int32_t>(r.to);
    }
  }
}

}  // namespace packbed
