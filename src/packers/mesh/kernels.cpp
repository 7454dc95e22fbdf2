#include "packers/mesh/kernels.hpp"

#include <algorithm>
#include <cmath>

#include "contact/cylinder.hpp"
#include "contact/sphere.hpp"

namespace packbed::mesh {
namespace {

FieldPellet field_of(const Model& model, const Bodies& bodies, std::uint32_t i) {
  return {model.kinds[bodies.kind[i]].field.get(), {bodies.position[i], bodies.rotation[i]}, bodies.scale[i]};
}

/// Of a sphere; its bounding radius holds the facets of its surface too.
double radius_of(const Model& model, const Bodies& bodies, std::uint32_t i) {
  return bodies.scale[i] * model.kinds[bodies.kind[i]].shape->radius;
}

Touch touch_wall(const Model& model, const Bodies& bodies, std::uint32_t a, std::uint32_t which,
                 double& gap) {
  const Vec3& x = bodies.position[a];
  const Kind& kind = model.kinds[bodies.kind[a]];
  if (which == kSolid) return touch_container(field_of(model, bodies, a), *model.wall_field, &gap);
  const double tube = model.container.radius;
  const bool floor = which == kFloor;
  gap = (floor ? x.z() : tube - std::hypot(x.x(), x.y())) - bodies.bounding_radius[a];
  if (gap > 0) return {};
  switch (kind.kernel) {
    case Kernel::sphere:
      return floor ? touch_floor(x, radius_of(model, bodies, a))
                   : touch_tube(x, radius_of(model, bodies, a), tube);
    case Kernel::cylinder:
      return floor ? touch_floor(rod_of(model, bodies, a), gap)
                   : touch_tube(rod_of(model, bodies, a), tube, gap);
    case Kernel::field:
      return floor ? touch_floor(field_of(model, bodies, a)) : touch_tube(field_of(model, bodies, a), tube);
  }
  return {};
}

Touch touch_rods(const Rod& a, const Rod& b, PairRecord& record, double& gap) {
  record.features.known = false;
  gap = separation(a, b);
  if (gap > 0) return {};
  const Touch touch = touch_cylinders(a, b, record.features);
  // an arc that has only just begun may not hold, and is looked for again at once
  gap = record.features.known ? record.features.due() : 0.0;
  return touch;
}

}  // namespace

Rod rod_of(const Model& model, const Bodies& bodies, std::uint32_t i) {
  const Shape& shape = *model.kinds[bodies.kind[i]].shape;
  const double scale = bodies.scale[i];
  return {bodies.position[i], bodies.axis[i], scale * shape.radius, scale * shape.half_height};
}

Touch touch_pair(const Model& model, const Bodies& bodies, const BodyPair& pair, PairRecord& record,
                 double& gap) {
  const auto [a, b] = pair;
  if (is_container(b)) return touch_wall(model, bodies, a, b, gap);
  const Kind &ka = model.kinds[bodies.kind[a]], &kb = model.kinds[bodies.kind[b]];
  const Vec3 &xa = bodies.position[a], &xb = bodies.position[b];
  gap = (xa - xb).norm() - bodies.bounding_radius[a] - bodies.bounding_radius[b];
  if (gap > 0) return {};
  if (ka.kernel == Kernel::sphere && kb.kernel == Kernel::sphere)
    return touch_spheres(xa, radius_of(model, bodies, a), xb, radius_of(model, bodies, b));
  if (ka.kernel == Kernel::field)
    return touch_field(field_of(model, bodies, a), field_of(model, bodies, b), &gap);
  return touch_rods(rod_of(model, bodies, a), rod_of(model, bodies, b), record, gap);
}

}  // namespace packbed::mesh
