#include "analysis/exact_radial.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/bins.hpp"
#include "analysis/mesh_in_cylinder.hpp"
#include "geometry/sphere_volume.hpp"
#include "math/quadrature.hpp"

namespace packbed {
namespace {

/// Length of the vertical line through (x, y) inside a cylinder and between two heights.
class VerticalChord {
 public:
  VerticalChord(const Shape& shape, const Pellet& p, double z_low, double z_high)
      : radius_(shape.radius * p.scale),
        half_(shape.half_height * p.scale),
        low_(z_low - p.pose.position.z()),
        high_(z_high - p.pose.position.z()),
        cx_(p.pose.position.x()),
        cy_(p.pose.position.y()) {
    const Mat3 own = p.pose.rotation.conjugate().toRotationMatrix();
    u_ = own.col(0);
    v_ = own.col(1);
    d_ = own.col(2);
    across_ = d_.head<2>().squaredNorm();
    upright_ = across_ < 1e-18;
    lying_ = std::abs(d_.z()) < 1e-12;
    per_across_ = upright_ ? 0 : 1 / across_;
    per_dz_ = lying_ ? 0 : 1 / d_.z();
  }
  double operator()(double x, double y) const {
    const double dx = x - cx_, dy = y - cy_;
    double from = -1e300, to = 1e300;
    const double ox = dx * u_.x() + dy * v_.x(), oy = dx * u_.y() + dy * v_.y(),
                 oz = dx * u_.z() + dy * v_.z();
    const double outside = ox * ox + oy * oy - radius_ * radius_;
    if (upright_) {
      if (outside >= 0) return 0;
    } else {
      const double b = ox * d_.x() + oy * d_.y(), rest = b * b - across_ * outside;
      if (rest <= 0) return 0;
      const double root = std::sqrt(rest);
      from = (-b - root) * per_across_;
      to = (-b + root) * per_across_;
    }
    if (lying_) {
      if (std::abs(oz) >= half_) return 0;
    } else {
      const double p = (half_ - oz) * per_dz_, q = (-half_ - oz) * per_dz_;
      from = std::max(from, std::min(p, q));
      to = std::min(to, std::max(p, q));
    }
    return std::max(0.0, std::min(to, high_) - std::max(from, low_));
  }

 private:
  bool upright_ = false, lying_ = false;
  double radius_, half_, low_, high_, cx_, cy_, across_ = 0, per_across_ = 0, per_dz_ = 0;
  Vec3 u_, v_, d_;  // world x, y, z in the pellet's own frame
};

class RingIntegral {
 public:
  explicit RingIntegral(const RadialRule& rule)
      : angles_(with_root_ends(rule.angles)), radii_(gauss_legendre(rule.radii)), scan_(rule.scan) {}

  /// Volume between r0 and r1 of a body whose shadow lies within `reach` of a point at `distance` from the
  /// axis, in the direction of angle `towards`.
  double operator()(const VerticalChord& chord, double distance, double towards, double reach, double r0,
                    double r1) const {
    r0 = std::max(r0, distance - reach);
    r1 = std::min(r1, distance + reach);
    if (r0 >= r1) return 0;
    double volume = 0;
    for (std::size_t i = 0; i < radii_.node.size(); ++i) {
      const double r = (r0 + r1) / 2 + (r1 - r0) / 2 * radii_.node[i];
      const double cosine =
          (r * r + distance * distance - reach * reach) / std::max(2 * r * distance, 1e-300);
      const double half = cosine <= -1 ? kPi : std::acos(std::min(1.0, cosine));
      volume += (r1 - r0) / 2 * radii_.weight[i] * r * round_the_axis(chord, r, towards, half);
    }
    return volume;
  }

 private:
  /// Integral of the chord over the angle, run by run of angles where there is one.
  double round_the_axis(const VerticalChord& chord, double r, double towards, double half) const {
    const auto at = [&](double angle) { return chord(r * std::cos(angle), r * std::sin(angle)); };
    const auto end_between = [&](double in, double out) {
      for (int k = 0; k < 14; ++k) (at((in + out) / 2) > 0 ? in : out) = (in + out) / 2;
      return (in + out) / 2;
    };
    double sum = 0, start = 0, last = towards - half;
    bool inside = at(last) > 0;
    if (inside) start = last;
    for (int i = 1; i <= scan_; ++i) {
      const double angle = towards - half + 2 * half * i / scan_;
      const bool now = at(angle) > 0;
      if (now && !inside) start = end_between(angle, last);
      if (inside && (!now || i == scan_)) sum += run(at, start, now ? angle : end_between(last, angle));
      inside = now;
      last = angle;
    }
    return sum;
  }
  template <class At>
  double run(const At& at, double from, double to) const {
    double sum = 0;
    for (std::size_t i = 0; i < angles_.node.size(); ++i)
      sum += angles_.weight[i] * at((from + to) / 2 + (to - from) / 2 * angles_.node[i]);
    return sum * (to - from) / 2;
  }

  Quadrature angles_, radii_;
  int scan_;
};

/// Radius of a circle round the middle of the shadow that holds it: the shadow is made of two ellipses
/// (radius, radius c), moved by half_height s along their short axes.
double shadow_reach(const Shape& shape, const Pellet& p) {
  const double c = std::abs((p.pose.rotation * Vec3::UnitZ()).z()), s = std::sqrt(std::max(0.0, 1 - c * c));
  const double shift = shape.half_height * s, r = shape.radius;
  // largest |(r sin t, shift + r c cos t)|: at t = 0, or where its derivative has its other zero
  const double cosine = s > 0 ? std::min(1.0, shift * c / (r * s * s)) : 0;
  return p.scale * std::hypot(r * std::sqrt(1 - cosine * cosine), shift + r * c * cosine) * (1 + 1e-12);
}

void add_sphere_rings(const Vec3& centre, double radius, const std::vector<double>& radii, double z_low,
                      double z_high, std::vector<double>& bins) {
  const double distance = centre.head<2>().norm();
  const auto within = [&](std::size_t k) {
    return radii[k] > 0 ? sphere_in_cylinder(centre, radius, radii[k], z_low, z_high) : 0.0;
  };
  const std::size_t first = bin_of(radii, std::max(radii.front(), distance - radius));
  double below = within(first);
  for (std::size_t k = first; k + 1 < radii.size() && radii[k] < distance + radius; ++k) {
    const double above = within(k + 1);
    bins[k] += above - below;
    below = above;
  }
}

}  // namespace

std::vector<double> ring_volumes(const PackedBed& bed, const std::vector<double>& radii, double z_low,
                                 double z_high, const RadialRule& rule) {
  const RingIntegral ring(rule);
  return gather_in_bins(bed.pellets.size(), radii.size() - 1, [&](std::size_t i, std::vector<double>& bins) {
    const Pellet& p = bed.pellets[i];
    const Shape& shape = *bed.shapes[p.shape];
    const double distance = p.pose.position.head<2>().norm(), bound = shape.bounding_radius * p.scale;
    if (p.pose.position.z() + bound <= z_low || p.pose.position.z() - bound >= z_high) return;
    if (seen_as_mesh(shape.kind)) {
      add_mesh_rings(shape.surface, p, radii, z_low, z_high, bins);
      return;
    }
    if (shape.kind == ShapeClass::sphere) {
      add_sphere_rings(p.pose.position, shape.radius * p.scale, radii, z_low, z_high, bins);
      return;
    }
    const double reach = shadow_reach(shape, p),
                 towards = std::atan2(p.pose.position.y(), p.pose.position.x());
    const VerticalChord chord(shape, p, z_low, z_high);
    const std::size_t first = bin_of(radii, std::max(radii.front(), distance - reach));
    for (std::size_t k = first; k + 1 < radii.size() && radii[k] < distance + reach; ++k)
      bins[k] += ring(chord, distance, towards, reach, radii[k], radii[k + 1]);
  });
}

}  // namespace packbed
