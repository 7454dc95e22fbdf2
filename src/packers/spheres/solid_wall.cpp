#include "packers/spheres/solid_wall.hpp"

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
  TouchSum<kPointExponent> sum(centre);
  for (const TriangleTree::Nearest& at : places) {
    const Vec3 inward = at.point - centre;
    sum.add(inward, radius - at.distance, 1.0, inward / at.distance);
  }
  const Touch touch = sum.finish(1.0, Vec3::Zero(), Vec3::Zero());
  const double length = touch.gradient.norm();
  if (length > 0) normal = touch.gradient / length;
  distance = radius - touch.delta * length;
}

}  // namespace packbed::spheres
