// The volume under a surface within the disc of radius r round the axis is the integral of its height over
// its shadow, signed by which way it faces. For one triangle, with height f linear over the plane, the shadow
// within the disc is a sum over its sides of signed pieces seen from the axis: triangles (axis, p, q) where
// the side runs inside the disc, sectors where it runs outside. Both have closed integrals of 1, x and y.
#include "analysis/mesh_in_cylinder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace packbed {
namespace {

constexpr double kSteepest = 1e6;  // slope of f; steeper triangles have shadows too thin to count (1e-6 of a
                                   // pellet's width and volume) and would only bring rounding

struct Moments {  // integrals of 1, x, y
  double one = 0, x = 0, y = 0;
};

struct Point {
  double x, y;
};

double cross(const Point& p, const Point& q) {
  return p.x * q.y - p.y * q.x;
}

void add_triangle(const Point& p, const Point& q, Moments& m) {
  const double area = 0.5 * cross(p, q);
  m.one += area;
  m.x += area * (p.x + q.x) / 3;
  m.y += area * (p.y + q.y) / 3;
}

void add_sector(double r, const Point& p, const Point& q,
                Moments& m) {  // from the direction of p to that of q
  const double np = std::hypot(p.x, p.y), nq = std::hypot(q.x, q.y);
  if (np == 0 || nq == 0) return;
  m.one += 0.5 * r * r * std::atan2(cross(p, q), p.x * q.x + p.y * q.y);
  m.x += r * r * r / 3 * (q.y / nq - p.y / np);
  m.y += r * r * r / 3 * (p.x / np - q.x / nq);
}

/// Side p -> q of a shadow, seen from the axis, within the disc of radius r.
void add_side(double r, const Point& p, const Point& q, Moments& m) {
  const double dx = q.x - p.x, dy = q.y - p.y, a = dx * dx + dy * dy, b = p.x * dx + p.y * dy,
               c = p.x * p.x + p.y * p.y - r * r;
  const double rest = b * b - a * c;
  if (a == 0) return;
  double from = 1, to = 1;  // part of the side inside the disc, as fractions of it
  if (rest > 0) {
    const double root = std::sqrt(rest);
    from = std::clamp((-b - root) / a, 0.0, 1.0);
    to = std::clamp((-b + root) / a, 0.0, 1.0);
  }
  if (from >= to) {
    add_sector(r, p, q, m);
    return;
  }
  const Point u{p.x + from * dx, p.y + from * dy}, v{p.x + to * dx, p.y + to * dy};
  if (from > 0) add_sector(r, p, u, m);
  add_triangle(u, v, m);
  if (to < 1) add_sector(r, v, q, m);
}

/// A flat polygon of the surface: corners in order, and its height as a linear function of x and y.
struct Facet {
  std::array<Vec3, 5> corner;
  int corners = 0;
  double height = 0, slope_x = 0, slope_y = 0;  // f = height + slope_x x + slope_y y
};

double integral_within(const Facet& f, double r) {
  Moments m;
  for (int i = 0; i < f.corners; ++i) {
    const Vec3 &p = f.corner[static_cast<std::size_t>(i)],
               &q = f.corner[static_cast<std::size_t>((i + 1) % f.corners)];
    add_side(r, {p.x(), p.y()}, {q.x(), q.y()}, m);
  }
  return f.height * m.one + f.slope_x * m.x + f.slope_y * m.y;
}

/// Keeps the part of a polygon where sign (z - level) >= 0.
Facet cut(const Facet& f, double level, double sign) {
  Facet out = f;
  out.corners = 0;
  for (int i = 0; i < f.corners; ++i) {
    const Vec3 &p = f.corner[static_cast<std::size_t>(i)],
               &q = f.corner[static_cast<std::size_t>((i + 1) % f.corners)];
    const double hp = sign * (p.z() - level), hq = sign * (q.z() - level);
    if (hp >= 0) out.corner[static_cast<std::size_t>(out.corners++)] = p;
    if ((hp < 0) != (hq < 0))
      out.corner[static_cast<std::size_t>(out.corners++)] = p + hp / (hp - hq) * (q - p);
  }
  return out;
}

Facet flat_at(Facet f, double level) {
  f.height = level;
  f.slope_x = f.slope_y = 0;
  return f;
}

/// Distance of the axis from a shadow; 0 when it runs through.
double nearest_of(const Facet& f) {
  double nearest = std::numeric_limits<double>::infinity();
  bool left = true, right = true;
  for (int i = 0; i < f.corners; ++i) {
    const Eigen::Vector2d p = f.corner[static_cast<std::size_t>(i)].head<2>(),
                          q = f.corner[static_cast<std::size_t>((i + 1) % f.corners)].head<2>(), side = q - p;
    const double turn = p.x() * q.y() - p.y() * q.x(), length = side.squaredNorm();
    left = left && turn >= 0;
    right = right && turn <= 0;
    const double t = length > 0 ? std::clamp(-p.dot(side) / length, 0.0, 1.0) : 0;
    nearest = std::min(nearest, (p + t * side).norm());
  }
  return left || right ? 0 : nearest;
}

/// Only discs that cut the shadow need work: smaller ones hold nothing of it, larger ones all.
void add_facet(const Facet& f, const std::vector<double>& radii, std::vector<double>& bins) {
  if (f.corners < 3) return;
  double furthest = 0;
  for (int i = 0; i < f.corners; ++i)
    furthest = std::max(furthest, f.corner[static_cast<std::size_t>(i)].head<2>().norm());
  const auto above = std::upper_bound(radii.begin(), radii.end(), nearest_of(f) * (1 - 1e-12));
  std::size_t k = above == radii.begin() ? 0 : static_cast<std::size_t>(above - radii.begin()) - 1;
  double within = integral_within(f, radii[k]);
  for (; k + 1 < radii.size(); ++k) {
    const double next = integral_within(f, radii[k + 1]);
    bins[k] += next - within;
    within = next;
    if (radii[k + 1] >= furthest) break;
  }
}

}  // namespace

void add_mesh_rings(const TriangleMesh& surface, const Pellet& pellet, const std::vector<double>& radii,
                    double z_low, double z_high, std::vector<double>& bins) {
  const Mat3 rotation = pellet.pose.rotation.toRotationMatrix() * pellet.scale;
  std::vector<Vec3> posed;
  for (const Vec3& v : surface.vertices) posed.push_back(rotation * v + pellet.pose.position);
  for (const auto& t : surface.triangles) {
    Facet f;
    for (std::size_t i = 0; i < 3; ++i) f.corner[i] = posed[static_cast<std::size_t>(t[i])];
    f.corners = 3;
    const Vec3 n = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]);
    if (std::hypot(n.x(), n.y()) >= kSteepest * std::abs(n.z())) continue;
    f.slope_x = -n.x() / n.z();
    f.slope_y = -n.y() / n.z();
    f.height = f.corner[0].z() - f.slope_x * f.corner[0].x() - f.slope_y * f.corner[0].y();
    const auto [low, high] = std::minmax({f.corner[0].z(), f.corner[1].z(), f.corner[2].z()});
    if (low >= z_low && high <= z_high) {
      add_facet(f, radii, bins);
      continue;
    }
    const Facet above_low = cut(f, z_low, 1);
    add_facet(flat_at(cut(f, z_low, -1), z_low), radii, bins);
    add_facet(cut(above_low, z_high, -1), radii, bins);
    add_facet(flat_at(cut(above_low, z_high, 1), z_high), radii, bins);
  }
}

}  // namespace packbed
