#pragma once
// Beds for tests of the analyses.
#include "../shapes.hpp"
#include "bed/packed_bed.hpp"
#include "math/random.hpp"

namespace packbed::test {

inline void add(PackedBed& bed, const Vec3& position, const Quat& rotation = Quat::Identity(),
                std::uint32_t shape = 0) {
  Pellet p;
  p.id = static_cast<std::uint32_t>(bed.pellets.size());
  p.shape = shape;
  p.pose = {position, rotation};
  bed.pellets.push_back(p);
}

inline PackedBed free_bed(const std::vector<ShapePtr>& shapes) {
  PackedBed bed;
  bed.container.kind = ContainerKind::none;
  bed.shapes = shapes;
  return bed;
}

inline PackedBed tube_bed(const std::vector<ShapePtr>& shapes, double radius) {
  PackedBed bed = free_bed(shapes);
  bed.container.kind = ContainerKind::tube;
  bed.container.radius = radius;
  bed.container.height = 1;
  return bed;
}

/// Pellets of random rotation on a cubic lattice in a tube, not touching each other or the wall when
/// `spacing` is larger than their bounding sphere.
inline PackedBed spread_bed(const ShapePtr& shape, double radius, double height, double spacing) {
  PackedBed bed = tube_bed({shape}, radius);
  const double reach = shape->bounding_radius;
  for (double z = reach; z < height - reach; z += spacing)
    for (double y = -radius; y < radius; y += spacing)
      for (double x = -radius; x < radius; x += spacing) {
        Random r(21, Stream::test, static_cast<std::uint32_t>(bed.pellets.size()));
        if (std::hypot(x, y) + reach < radius) add(bed, {x, y, z}, r.rotation());
      }
  return bed;
}

inline Quat turned(double radians, const Vec3& axis) {
  return Quat(Eigen::AngleAxisd(radians, axis));
}

}  // namespace packbed::test
