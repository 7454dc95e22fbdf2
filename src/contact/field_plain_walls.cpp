// The points of a body against a floor and against the wall of a tube: no field is needed, the depth is in
// closed form.
#include <cmath>

#include "contact/field.hpp"

namespace packbed {
namespace {

/// Adds every point of the pellet that is deep; depth(x, slope) of a world point, clusters beyond `outside`
/// are skipped.
template <class Depth, class Outside>
Touch touch_points(const FieldPellet& a, const Depth& depth, const Outside& outside) {
  const SurfacePoints& p = a.body->points;
  TouchSum<kPointExponent> sum(a.pose.position);
  for (std::size_t c = 0; c < p.clusters(); ++c) {
    const Vec3 centre = a.pose.to_world(a.scale * Vec3(p.cluster_x[c], p.cluster_y[c], p.cluster_z[c]));
    if (outside(centre) >= a.scale * p.cluster_radius[c]) continue;
    for (std::size_t i = c * kCluster; i < (c + 1) * kCluster; ++i) {
      if (!(p.weight[i] > 0)) continue;
      const Vec3 x = a.pose.to_world(a.scale * Vec3(p.x[i], p.y[i], p.z[i]));
      Vec3 slope;
      const double d = depth(x, slope);
      if (d > 0) sum.add(x - a.pose.position, d, a.scale * p.weight[i], slope);
    }
  }
  return sum.finish(2.0 * kPi * a.scale * a.body->size, Vec3::Zero(), Vec3::Zero());
}

}  // namespace

Touch touch_floor(const FieldPellet& a) {
  return touch_points(
      a,
      [](const Vec3& x, Vec3& slope) {
        slope = Vec3(0, 0, -1);
        return -x.z();
      },
      [](const Vec3& centre) { return centre.z(); });
}

Touch touch_tube(const FieldPellet& a, double tube) {
  return touch_points(
      a,
      [tube](const Vec3& x, Vec3& slope) {
        slope = Vec3(x.x() / tube, x.y() / tube, 0);
        return (x.x() * x.x() + x.y() * x.y() - tube * tube) / (2.0 * tube);
      },
      [tube](const Vec3& centre) { return tube - std::hypot(centre.x(), centre.y()); });
}

}  // namespace packbed
