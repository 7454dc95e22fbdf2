#include "packers/spheres/solid_wall.hpp"

#include <cmath>

#include "contact/touch.hpp"

namespace packbed::spheres {

void SolidWall::side(double radius, const Vec3& centre, Vec3& normal, double& distance) const {
  thread_local std::vector<TriangleTree::Nearest> places;
  tree_.nearest_places(centre, radius, places);
  normal = Vec3::UnitZ();
  distance = radius;
  if (places.empty()) return;
  const TriangleTree::Nearest& first = places.front();
  if (first.distance <= 0) {  // so deep that it has to get out by the shortest way
    if (first.distance < 0) normal = (first.point - centre) / -first.distance;
    distance = first.distance;
    return;
  }
  // fractions of the deepest, so that powers neither vanish nor overflow
  const double deepest = radius - first.distance;
  double sum = 0;
  Vec3 push = Vec3::Zero();
  for (const TriangleTree::Nearest& at : places) {
    const double depth = (radius - at.distance) / deepest, d2 = depth * depth, d4 = d2 * d2;
    sum += depth_power<kPointExponent>(depth);
    push += d4 * d2 * depth * (centre - at.point) / at.distance;
  }
  // delta = sum^(1/p), gradient = (depth / delta)^(p - 1) n
  const double delta = std::sqrt(std::sqrt(std::sqrt(sum)));
  const Vec3 gradient = delta / sum * push;
  const double length = gradient.norm();
  normal = length > 0 ? Vec3(gradient / length) : Vec3(Vec3::UnitZ());
  distance = radius - deepest * delta * length;
}

}  // namespace packbed::spheres
