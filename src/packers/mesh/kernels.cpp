#include "packers/mesh/kernels.hpp"

#include <algorithm>
#include <cmath>

#include "contact/cylinder.hpp"
#include "contact/sphere.hpp"

namespace packbed::mesh {
namespace {

Rod rod_of(const Model& model, const Bodies& bodies, std::uint32_t i) {
  const Shape& shape = *model.kinds[bodies.kind[i]].shape;
  return {bodies.position[i], bodies.axis[i], shape.radius, shape.half_height};
}

Touch touch_container(const Model& model, const Bodies& bodies, std::uint32_t a, std::uint32_t which,
                      double& gap) {
  const Vec3& x = bodies.position[a];
  const Kind& kind = model.kinds[bodies.kind[a]];
  const double tube = model.container.radius;
  gap = (which == kFloor ? x.z() : tube - std::hypot(x.x(), x.y())) - kind.bounding_radius;
  if (gap > 0) return {};
  if (kind.kernel == Kernel::sphere)
    return which == kFloor ? touch_floor(x, kind.shape->radius) : touch_tube(x, kind.shape->radius, tube);
  const Rod rod = rod_of(model, bodies, a);
  return which == kFloor ? touch_floor(rod) : touch_tube(rod, tube);
}

/// Looks at the features that touched last time; at all of them once the bodies may have come into reach of
/// others.
Touch touch_rods(const Rod& a, const Rod& b, double travelled, PairRecord& record, double& gap) {
  if (record.features.mask != 0 && travelled < record.features_until) {
    const Touch touch = touch_cylinders(a, b, record.features);
    if (touch.delta > 0) return touch;
  }
  record.features.mask = 0;
  gap = separation(a, b);
  if (gap > 0) return {};
  RodFeatures features;
  const Touch touch = touch_cylinders(a, b, features);
  gap = features.gap;
  if (touch.delta > 0) {
    record.features = features;
    record.features_until = travelled + features.gap;
  }
  return touch;
}

}  // namespace

Touch touch_pair(const Model& model, const Bodies& bodies, const BodyPair& pair, double travelled,
                 PairRecord& record, double& gap) {
  const auto [a, b] = pair;
  if (is_container(b)) return touch_container(model, bodies, a, b, gap);
  const Kind &ka = model.kinds[bodies.kind[a]], &kb = model.kinds[bodies.kind[b]];
  const Vec3 &xa = bodies.position[a], &xb = bodies.position[b];
  gap = (xa - xb).norm() - ka.bounding_radius - kb.bounding_radius;
  if (gap > 0) return {};
  if (ka.kernel == Kernel::sphere && kb.kernel == Kernel::sphere)
    return touch_spheres(xa, ka.shape->radius, xb, kb.shape->radius);
  return touch_rods(rod_of(model, bodies, a), rod_of(model, bodies, b), travelled, record, gap);
}

}  // namespace packbed::mesh
