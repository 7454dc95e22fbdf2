#include "analysis/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace packbed {
namespace {

constexpr int kClasses = 9;
constexpr double kClassDegrees = 10;
constexpr double kSameMoment =
    0.01;  // moments closer than this show no axis: facets and CAD tolerances differ by less

std::array<double, 2> lambert(const Vec3& axis) {
  const Vec3 down = axis.z() > 0 ? Vec3(-axis) : axis;
  const double shrink = 1 / std::sqrt(1 - down.z());
  return {down.x() * shrink, down.y() * shrink};
}

Orientation empty_classes() {
  Orientation o;
  for (int k = 0; k < kClasses; ++k) {
    o.from_deg.push_back(k * kClassDegrees);
    o.to_deg.push_back((k + 1) * kClassDegrees);
    o.isotropic.push_back(std::cos(k * kClassDegrees * kPi / 180) -
                          std::cos((k + 1) * kClassDegrees * kPi / 180));
  }
  o.count.assign(kClasses, 0);
  return o;
}

}  // namespace

std::optional<Vec3> shape_axis(const Shape& shape) {
  if (shape.kind == ShapeClass::sphere) return std::nullopt;
  if (shape.kind == ShapeClass::cylinder || shape.kind == ShapeClass::tube) return Vec3::UnitZ();
  const Vec3& i = shape.inertia;
  if (i.maxCoeff() - i.minCoeff() <= kSameMoment * i.maxCoeff()) return std::nullopt;
  // the two that are closest to each other leave the third one apart; z wins a tie
  const Vec3 gap(std::abs(i.y() - i.z()), std::abs(i.z() - i.x()), std::abs(i.x() - i.y()));
  int apart = 2;
  for (int d : {1, 0})
    if (gap[d] < gap[apart]) apart = d;
  return Vec3::Unit(apart);
}

Orientation orientation(const PackedBed& bed) {
  Orientation o = empty_classes();
  std::vector<std::optional<Vec3>> axes;
  for (const ShapePtr& shape : bed.shapes) axes.push_back(shape_axis(*shape));
  for (const Pellet& p : bed.pellets) {
    if (!axes[p.shape]) {
      o.angle_deg.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const Vec3 axis = p.pose.rotation * *axes[p.shape];
    const double angle = std::atan2(axis.head<2>().norm(), std::abs(axis.z())) * 180 / kPi;
    o.angle_deg.push_back(angle);
    o.lambert.push_back(lambert(axis));
    ++o.count[static_cast<std::size_t>(std::min(kClasses - 1, static_cast<int>(angle / kClassDegrees)))];
  }
  for (const int n : o.count)
    o.fraction.push_back(o.lambert.empty() ? 0
                                           : static_cast<double>(n) / static_cast<double>(o.lambert.size()));
  return o;
}

}  // namespace packbed
