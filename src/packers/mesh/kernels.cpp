#include "packers/mesh/kernels.hpp"

#include <algorithm>
#include <cmath>

#include "contact/cylinder.hpp"
#include "contact/sphere.hpp"

namespace packbed::mesh {
namespace {

/// Of a sphere; its bounding radius holds the facets of its surface too.
double radius_of(const Model& model, const Bodies& bodies, std::uint32_t i) {
  return bodies.scale[i] * model.kinds[bodies.kind[i]].shape->radius;
}

/// The side of a box is a floor that has been turned up.
Touch touch_side(const Model& model, const Bodies& bodies, std::uint32_t a, const BoxSide& side,
                 double& gap) {
  const Kind& kind = model.kinds[bodies.kind[a]];
  const Vec3& x = bodies.position[a];
  gap = side.distance(x) - bodies.bounding_radius[a];
  if (gap > 0) return {};
  const Quat lay = Quat::FromTwoVectors(side.inwards, Vec3::UnitZ()), raise = lay.conjugate();
  const Vec3 up = side.half * Vec3::UnitZ(), laid = lay * x + up;
  Touch t;
  if (kind.kernel == Kernel::sphere) {
    t = touch_floor(laid, radius_of(model, bodies, a));
  } else {
    Rod rod = rod_of(model, bodies, a);
    rod.centre = laid;
    rod.axis = lay * rod.axis;
    t = touch_floor(rod, gap);
  }
  t.gradient = raise * t.gradient;
  t.torque_a = raise * t.torque_a;
  t.torque_b = raise * t.torque_b;
  t.point = raise * (t.point - up);
  const Mat3 turn = raise.toRotationMatrix();
  t.patch = turn * t.patch * turn.transpose();
  return t;
}

Touch touch_wall(const Model& model, const Bodies& bodies, std::uint32_t a, std::uint32_t which,
                 double& gap) {
  if (is_side(which)) return touch_side(model, bodies, a, side_of(model.container, which - kSide), gap);
  const Vec3& x = bodies.position[a];
  const Kind& kind = model.kinds[bodies.kind[a]];
  const double tube = model.container.radius;
  const bool floor = which == kFloor;
  gap = (floor ? x.z() : tube - std::hypot(x.x(), x.y())) - bodies.bounding_radius[a];
  if (gap > 0) return {};
  if (kind.kernel == Kernel::sphere)
    return floor ? touch_floor(x, radius_of(model, bodies, a))
                 : touch_tube(x, radius_of(model, bodies, a), tube);
  return floor ? touch_floor(rod_of(model, bodies, a), gap) : touch_tube(rod_of(model, bodies, a), tube, gap);
}

Touch touch_rods(const Rod& a, const Rod& b, RodFeatures& features, double& gap) {
  features.known = false;
  gap = separation(a, b);
  if (gap > 0) return {};
  const Touch touch = touch_cylinders(a, b, features);
  // an arc that has only just begun may not hold, and is looked for again at once
  gap = features.known ? features.due() : 0.0;
  return touch;
}

}  // namespace

BoxSide side_of(const Container& box, std::uint32_t number) {
  const Vec3 along = number < 2 ? Vec3::UnitX() : Vec3::UnitY();
  return {number % 2 == 0 ? Vec3(-along) : along, 0.5 * (number < 2 ? box.width : box.depth)};
}

Rod rod_of(const Model& model, const Bodies& bodies, std::uint32_t i) {
  const Shape& shape = *model.kinds[bodies.kind[i]].shape;
  const double scale = bodies.scale[i];
  return {bodies.position[i], bodies.axis[i], scale * shape.radius, scale * shape.half_height};
}

Touch touch_pair(const Model& model, const Bodies& bodies, const BodyPair& pair, RodFeatures& features,
                 double& gap) {
  const auto [a, b] = pair;
  if (is_container(b)) return touch_wall(model, bodies, a, b, gap);
  const Kind &ka = model.kinds[bodies.kind[a]], &kb = model.kinds[bodies.kind[b]];
  const Vec3 &xa = bodies.position[a], &xb = bodies.position[b];
  gap = (xa - xb).norm() - bodies.bounding_radius[a] - bodies.bounding_radius[b];
  if (gap > 0) return {};
  if (ka.kernel == Kernel::sphere && kb.kernel == Kernel::sphere)
    return touch_spheres(xa, radius_of(model, bodies, a), xb, radius_of(model, bodies, b));
  return touch_rods(rod_of(model, bodies, a), rod_of(model, bodies, b), features, gap);
}

}  // namespace packbed::mesh
