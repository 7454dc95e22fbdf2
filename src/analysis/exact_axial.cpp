#include "analysis/exact_axial.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/bins.hpp"
#include "bed/pellet_box.hpp"

namespace packbed {
namespace {

double sphere_below(double radius, double z) {
  const double h = std::clamp(z + radius, 0.0, 2 * radius);  // height of the cap
  return kPi * h * h * (radius - h / 3);
}

// A tilted cylinder is the disc (p, q) swept along its axis by u; a point is at height u c + p s. Below z
// lies, over every chord of the disc at p, the length clamp((z - p s) / c + h, 0, 2 h): full for p under
// p_full, none over p_none. With S(p) = int 2 sqrt(R^2 - p^2) dp and M(p) = int 2 p sqrt(R^2 - p^2) dp the
// integral is closed.
double cylinder_below(double radius, double half_height, double cosine, double z) {
  const double c = std::abs(cosine), s = std::sqrt(std::max(0.0, 1 - c * c)), h = half_height,
               r2 = radius * radius;
  if (s < 1e-9) return kPi * r2 * std::clamp(z + h, 0.0, 2 * h);
  const auto area = [&](double p) {
    return p * std::sqrt(std::max(0.0, r2 - p * p)) + r2 * std::asin(p / radius);
  };
  const auto moment = [&](double p) { return -2.0 / 3.0 * std::pow(std::max(0.0, r2 - p * p), 1.5); };
  const double full = std::clamp((z - h * c) / s, -radius, radius),
               none = std::clamp((z + h * c) / s, -radius, radius);
  const double below = 2 * h * (area(full) + r2 * kPi / 2);
  if (c < 1e-6)
    return below + h * (area(none) - area(full));  // nearly lying: the length falls linearly in between
  return below + ((z + h * c) * (area(none) - area(full)) - s * (moment(none) - moment(full))) / c;
}

// Divergence theorem with the field (0, 0, z - z0), which vanishes on the cut: the volume below z0 is the
// integral of (z - z0) over the surface below, as seen from above. Over a triangle the mean of max(0, g) is
// closed for linear g.
double mean_positive(double a, double b, double c) {
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  if (c <= 0) return 0;
  if (a >= 0) return (a + b + c) / 3;
  if (b <= 0) return c * c * c / (3 * (c - a) * (c - b));
  return (a + b + c) / 3 - a * a * a / (3 * (b - a) * (c - a));
}

/// Adds to `below` (one a height) what a mesh has below each height; heights ascend.
class MeshBelow {
 public:
  MeshBelow(const Shape& shape, const Pellet& pellet) : triangles_(shape.surface.triangles) {
    const Mat3 rotation = pellet.pose.rotation.toRotationMatrix() * pellet.scale;
    for (const Vec3& v : shape.surface.vertices) posed_.push_back(rotation * v + pellet.pose.position);
  }
  void add(const std::vector<double>& heights, std::size_t first, std::size_t last, double sign,
           std::vector<double>& below) const {
    for (const auto& t : triangles_) {
      const Vec3 &a = at(t[0]), &b = at(t[1]), &c = at(t[2]);
      const double from_above = 0.5 * ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()));
      if (from_above == 0) continue;
      for (std::size_t k = first; k < last; ++k)
        below[k] -=
            sign * from_above * mean_positive(heights[k] - a.z(), heights[k] - b.z(), heights[k] - c.z());
    }
  }

 private:
  const Vec3& at(std::int32_t i) const { return posed_[static_cast<std::size_t>(i)]; }
  const std::vector<std::array<std::int32_t, 3>>& triangles_;
  std::vector<Vec3> posed_;
};

}  // namespace

double volume_below(const Shape& shape, const Pellet& pellet, double z) {
  const double local = z - pellet.pose.position.z();
  if (shape.kind == ShapeClass::sphere) return sphere_below(shape.radius * pellet.scale, local);
  if (shape.kind == ShapeClass::cylinder)
    return cylinder_below(shape.radius * pellet.scale, shape.half_height * pellet.scale,
                          (pellet.pose.rotation * Vec3::UnitZ()).z(), local);
  std::vector<double> below(1, 0.0);
  MeshBelow(shape, pellet).add({z}, 0, 1, 1, below);
  return below[0];
}

std::vector<double> slab_volumes(const PackedBed& bed, const std::vector<double>& edges) {
  const std::vector<double> below =
      gather_in_bins(bed.pellets.size(), edges.size(), [&](std::size_t i, std::vector<double>& bins) {
        const Pellet& p = bed.pellets[i];
        const Shape& shape = *bed.shapes[p.shape];
        const double low = -reach(shape, p, -Vec3::UnitZ()), high = reach(shape, p, Vec3::UnitZ());
        const auto first =
            static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), low) - edges.begin());
        const auto last =
            static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), high) - edges.begin());
        std::vector<double> own(edges.size(), 0.0);
        if (seen_as_mesh(shape.kind))
          MeshBelow(shape, p).add(edges, first, last, 1, own);
        else
          for (std::size_t k = first; k < last; ++k) own[k] = volume_below(shape, p, edges[k]);
        const double whole = shape.volume * p.scale * p.scale * p.scale;
        // as differences, so that a bin holds the sum of small volumes and not the difference of large ones
        double before = 0;
        for (std::size_t k = first; k < last; ++k) {
          if (k > 0) bins[k - 1] += own[k] - before;
          before = own[k];
        }
        if (last > 0 && last < edges.size()) bins[last - 1] += whole - before;
      });
  return {below.begin(), below.end() - 1};
}

}  // namespace packbed
