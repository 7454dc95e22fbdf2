#include "bench/contact_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace packbed::bench {
namespace {

// The circles of docs/mesh_packer.md, written down a second time on purpose: fractions of radius and half
// height.
constexpr std::array<std::array<double, 2>, 5> kCircles = {
    {{1, 1}, {0.7, 1}, {0.97, 1}, {1, 0.6}, {1, 0.97}}};
constexpr double kSideLength = 0.05, kParallel = 0.03;  // weight of crossed sides, and where it fades
constexpr int kFewest = 1024, kMost = 1 << 20;          // points a circle

using Sum = TouchSum<kCurveExponent>;

/// A circle of `owner` that may dip into `other`; `sign` +1 when the owner is a.
struct Ring {
  Vec3 centre, u, v;
  double radius;
  const Rod &owner, &other;
  double sign;

  Vec3 at(double phi) const { return centre + radius * (std::cos(phi) * u + std::sin(phi) * v); }
};

/// Adds the middles of the finest parts of [from, to]; no part is split that is farther from the other body
/// than it is long. Returns how many were inside.
int add_part(Sum& sum, const Ring& ring, double from, double to, double finest) {
  const double middle = 0.5 * (from + to), length = ring.radius * (to - from);
  const Vec3 x = ring.at(middle), y = x - ring.other.centre;
  const double z = y.dot(ring.other.axis), rho = (y - z * ring.other.axis).norm();
  if (std::max(rho - ring.other.radius, std::abs(z) - ring.other.half_height) > 0.5 * length) return 0;
  if (to - from > 1.5 * finest)
    return add_part(sum, ring, from, middle, finest) + add_part(sum, ring, middle, to, finest);
  Vec3 slope, more_slope;
  const Rod& other = ring.other;
  const double d = depth_in_cylinder(y, other.axis, other.radius, other.half_height, slope);
  if (!(d > 0)) return 0;
  const double cosine = ring.owner.axis.dot(other.axis), sine2 = 1 - cosine * cosine;
  const double more = more_at_edge(y, other.axis, other.radius, other.half_height, more_slope);
  sum.add(x, d, length * (1 + sine2 * more), ring.sign * slope);
  // the weight changes as the point moves and as the owner turns
  const double power = length * depth_power<kCurveExponent>(d);
  const Vec3 by_place = ring.sign * power * sine2 * more_slope;
  const Vec3 by_turn = -ring.sign * 2 * cosine * power * more * ring.owner.axis.cross(other.axis);
  sum.add_sums(0, by_place, x.cross(by_place) + by_turn, {}, 0);
  return 1;
}

/// Adds the circles of `owner` in `other`, each by `points` points.
int add_circles(Sum& sum, const Rod& owner, const Rod& other, double sign, int points) {
  const Vec3 u = owner.axis.unitOrthogonal(), v = owner.axis.cross(u);
  int inside = 0;
  for (const auto& [wide, high] : kCircles)
    for (const double end : {-1.0, 1.0}) {
      const Vec3 centre = owner.centre + end * high * owner.half_height * owner.axis;
      const Ring ring{centre, u, v, wide * owner.radius, owner, other, sign};
      inside += add_part(sum, ring, 0, 2 * kPi, 2 * kPi / points);
    }
  return inside;
}

struct Crossing {
  double power = 0;
  double smooth = 0, depth = 0;  // R-function of the distances, and the least of them [m]
  Vec3 point = Vec3::Zero();
};

/// Weight times depth to the 16th of two crossed sides at the common perpendicular of their axes.
Crossing crossing(const Rod& a, const Rod& b) {
  const Vec3 w = b.centre - a.centre;
  const double c = a.axis.dot(b.axis), sine2 = 1 - c * c;
  if (sine2 < 1e-8) return {};
  const double s = (w.dot(a.axis) - c * w.dot(b.axis)) / sine2,
               t = (c * w.dot(a.axis) - w.dot(b.axis)) / sine2;
  const Vec3 across = w + t * b.axis - s * a.axis;
  const double radii = a.radius + b.radius, side = (radii * radii - across.squaredNorm()) / (2 * radii);
  const auto end = [](double half, double at) { return (half * half - at * at) / (2 * half); };
  const double end_a = end(a.half_height, s), end_b = end(b.half_height, t);
  if (!(side > 0 && end_a > 0 && end_b > 0)) return {};
  const double ends = end_a + end_b - std::hypot(end_a, end_b);
  const double length = kSideLength * 2 * kPi * std::min(a.radius, b.radius) * sine2 /
                        (sine2 + kParallel * kParallel) * (2 * end_a / a.half_height) *
                        (2 * end_b / b.half_height);
  const double smooth = side + ends - std::hypot(side, ends);
  return {length * depth_power<kCurveExponent>(smooth), smooth, std::min(side, ends),
          a.centre + s * a.axis + (a.radius / radii) * across};
}

void add_crossing(Sum& sum, const Rod& a, const Rod& b) {
  const Crossing now = crossing(a, b);
  if (!(now.power > 0)) return;
  const double h = 1e-5 * a.radius;
  Vec3 by_place, by_turn;
  for (int k = 0; k < 3; ++k) {
    const auto slope = [&](const auto& moved) {
      return (crossing(moved(h), b).power - crossing(moved(-h), b).power) / (2 * h);
    };
    by_place[k] = slope([&](double way) {
      Rod r = a;
      r.centre[k] += way;
      return r;
    });
    by_turn[k] = a.radius * slope([&](double way) {
                   Rod r = a;
                   r.axis = Eigen::AngleAxisd(way / a.radius, Vec3::Unit(k)) * r.axis;
                   return r;
                 });
  }
  const double rate = kCurveExponent * now.power / now.smooth;
  sum.add_sums(now.power, by_place, by_turn + a.centre.cross(by_place),
               {rate, rate * now.point, rate * now.point * now.point.transpose()}, now.depth);
}

/// Two unit vectors and the direction that they stand on.
struct Frame {
  Vec3 n, u, v;
};

/// A rectangle of lines along n, by the middles of its cells.
struct Window {
  double u0, u1, v0, v1;
  double area(int cells) const { return (u1 - u0) * (v1 - v0) / (cells * cells); }
};

/// Part of the line through x that lies in both bodies.
std::pair<double, double> common(const Body& a, const Body& b, const Vec3& x, const Vec3& n) {
  const auto p = a.chord(x, n), q = b.chord(x, n);
  return {std::max(p.first, q.first), std::min(p.second, q.second)};
}

/// Calls visit(x, from, to, u, v) for the lines of a window that meet the overlap.
template <class Visit>
void for_lines(const Body& a, const Body& b, const Vec3& origin, const Frame& f, const Window& w, int cells,
               const Visit& visit) {
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const double u = w.u0 + (w.u1 - w.u0) * (i + 0.5) / cells, v = w.v0 + (w.v1 - w.v0) * (j + 0.5) / cells;
      const Vec3 x = origin + u * f.u + v * f.v;
      const auto [from, to] = common(a, b, x, f.n);
      if (from < to) visit(x, from, to, u, v);
    }
}

/// The window round the overlap: shrinks while it may lose more than a third of its area.
Window close_window(const Body& a, const Body& b, const Vec3& origin, const Frame& f) {
  constexpr int kCells = 32;
  const double reach = 2 * std::max(a.bounding_radius(), b.bounding_radius());
  Window window{-reach, reach, -reach, reach};
  for (int round = 0; round < 12; ++round) {  // an overlap too small for them is not found at all
    Window hit{0, 0, 0, 0};                   // the origin lies in the overlap
    for_lines(a, b, origin, f, window, kCells, [&](const Vec3&, double, double, double u, double v) {
      hit = {std::min(hit.u0, u), std::max(hit.u1, u), std::min(hit.v0, v), std::max(hit.v1, v)};
    });
    const double du = (window.u1 - window.u0) / kCells, dv = (window.v1 - window.v0) / kCells;
    const Window next{hit.u0 - du, hit.u1 + du, hit.v0 - dv, hit.v1 + dv};
    const bool close = next.area(1) > 0.67 * window.area(1);
    window = next;
    if (close) break;
  }
  return window;
}

/// Gradient of the difference of the two depths.
Vec3 slope_of_difference(const Body& a, const Body& b, const Vec3& x) {
  const double h = 1e-6 * a.bounding_radius();
  Vec3 slope;
  for (int k = 0; k < 3; ++k) {
    const Vec3 ahead = x + h * Vec3::Unit(k), behind = x - h * Vec3::Unit(k);
    slope[k] = (a.depth(ahead) - b.depth(ahead) - a.depth(behind) + b.depth(behind)) / (2 * h);
  }
  return slope;
}

}  // namespace

Touch converged_cylinders(const Rod& a_world, const Rod& b_world) {
  const Vec3 origin = 0.5 * (a_world.centre + b_world.centre);
  Rod a = a_world, b = b_world;
  a.centre -= origin;
  b.centre -= origin;
  Touch last;
  for (int points = kFewest; points <= kMost; points *= 2) {
    Sum sum(origin);
    const int inside = add_circles(sum, a, b, 1.0, points) + add_circles(sum, b, a, -1.0, points);
    add_crossing(sum, a, b);
    const Touch touch = sum.finish(2 * kPi * std::min(a.radius, b.radius), a.centre, b.centre);
    const bool same = std::abs(touch.delta - last.delta) <= 1e-5 * touch.delta &&
                      (touch.gradient - last.gradient).norm() <= 1e-5 * touch.gradient.norm();
    if (points > kFewest && same && (inside == 0 || inside > 100)) return touch;
    last = touch;
  }
  return last;
}

std::optional<PressureTouch> pressure_field(const Body& a, const Body& b, const Penetration& p, int columns) {
  const Frame f{p.normal, p.normal.unitOrthogonal(), p.normal.cross(p.normal.unitOrthogonal())};
  const Window window = close_window(a, b, p.point, f);
  PressureTouch out;
  double total = 0;
  for_lines(a, b, p.point, f, window, columns, [&](const Vec3& x, double from, double to, double, double) {
    // a is left along n, so its depth falls along the line where b's rises
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (from + to);
      (a.depth(x + middle * f.n) > b.depth(x + middle * f.n) ? from : to) = middle;
    }
    const Vec3 at = x + 0.5 * (from + to) * f.n, slope = slope_of_difference(a, b, at);
    const double along = slope.dot(f.n);
    if (!(along < 0)) return;
    // a is pushed against the way in which its depth falls
    const Vec3 push = window.area(columns) * a.depth(at) / -along * slope;
    out.force += push;
    out.torque += at.cross(push);
    out.point += push.norm() * at;
    total += push.norm();
  });
  if (!(total > 0)) return {};
  out.point /= total;
  return out;
}

double distance_of_action(const Vec3& force, const Vec3& torque, const Vec3& point) {
  const Vec3 foot = force.cross(torque) / force.squaredNorm();
  return (point - foot).cross(force.normalized()).norm();
}

}  // namespace packbed::bench
