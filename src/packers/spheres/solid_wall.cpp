#include "packers/spheres/solid_wall.hpp"

namespace packbed::spheres {

SolidWall::SolidWall(const Container& container, const std::vector<ShapePtr>& shapes, double thinnest)
    : tree_(container.surface), field_(make_field_wall(container, thinnest)) {
  for (const ShapePtr& shape : shapes) bodies_.push_back(make_field_body(*shape));
}

void SolidWall::side(std::uint32_t kind, double scale, double radius, const Vec3& centre, Vec3& normal,
                     double& distance) const {
  const Touch t = touch_container({&bodies_[kind], {centre, Quat::Identity()}, scale}, field_);
  const double length = t.gradient.norm();
  normal = length > 0 ? Vec3(t.gradient / length) : Vec3(Vec3::UnitZ());
  distance = radius - t.delta * length;
}

}  // namespace packbed::spheres
