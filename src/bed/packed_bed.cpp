#include "bed/packed_bed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "bed/pellet_box.hpp"
#include "math/hash.hpp"

namespace packbed {
namespace {

void add(Hash& hash, const Vec3& v) {
  for (int d = 0; d < 3; ++d) hash.add(v[d]);
}

void add(Hash& hash, const Shape& shape) {
  hash.add(static_cast<int>(shape.kind));
  hash.add(shape.radius);
  hash.add(shape.half_height);
  if (!seen_as_mesh(shape.kind)) return;
  for (const Vec3& v : shape.surface.vertices) add(hash, v);
  for (const auto& t : shape.surface.triangles) hash.add(t);
}

template <class Counts>
double top_of(const PackedBed& bed, const Counts& counts) {
  double top = 0;
  for (const Pellet& p : bed.pellets)
    if (counts(p)) top = std::max(top, reach(*bed.shapes[p.shape], p, Vec3::UnitZ()));
  return top;
}

}  // namespace

std::string bed_hash(const PackedBed& bed) {
  Hash hash;
  for (const ShapePtr& shape : bed.shapes) add(hash, *shape);
  for (const Pellet& p : bed.pellets) {
    hash.add(p.id);
    hash.add(p.shape);
    add(hash, p.pose.position);
    for (double q : {p.pose.rotation.w(), p.pose.rotation.x(), p.pose.rotation.y(), p.pose.rotation.z()})
      hash.add(q);
    hash.add(p.scale);
  }
  return hash.hex();
}

double bed_top(const PackedBed& bed) {
  return top_of(bed, [](const Pellet&) { return true; });
}

double settled_top(const PackedBed& bed) {
  if (bed.contacts.empty()) return bed_top(bed);
  std::unordered_set<std::uint32_t> touching;
  for (const Contact& c : bed.contacts) touching.insert(c.a), touching.insert(c.b);
  return top_of(bed, [&](const Pellet& p) { return p.fixed || touching.contains(p.id); });
}

double reach(const Shape& shape, const Pellet& pellet, const Vec3& direction) {
  const double centre = direction.dot(pellet.pose.position);
  if (shape.kind == ShapeClass::sphere) return centre + pellet.scale * shape.radius;
  const Vec3 local = pellet.pose.rotation.conjugate() * direction;
  if (shape.kind == ShapeClass::cylinder || shape.kind == ShapeClass::tube)
    return centre + pellet.scale * (shape.radius * std::hypot(local.x(), local.y()) +
                                    shape.half_height * std::abs(local.z()));
  double far = -std::numeric_limits<double>::infinity();
  for (const Vec3& v : shape.surface.vertices) far = std::max(far, local.dot(v));
  return centre + pellet.scale * far;
}

Box3 bounding_box(const Shape& shape, const Pellet& pellet) {
  Vec3 low, high;
  for (int d = 0; d < 3; ++d) {
    low[d] = -reach(shape, pellet, -Vec3::Unit(d));
    high[d] = reach(shape, pellet, Vec3::Unit(d));
  }
  return {low, high};
}

Box3 bounding_box(const PackedBed& bed) {
  Box3 box;
  for (const Pellet& p : bed.pellets) box.extend(bounding_box(*bed.shapes[p.shape], p));
  return box;
}

}  // namespace packbed
