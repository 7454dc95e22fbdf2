#pragma once
// A pellet as plain geometry: furthest points, chords, depth of a point. Shares nothing with the contact
// kernels, so that the audit of a run is an independent witness.
#include <memory>
#include <utility>
#include <vector>

#include "bed/packed_bed.hpp"
#include "mesh/convex.hpp"
#include "mesh/inside.hpp"

namespace packbed {

/// What a shape needs beyond itself to be asked these questions; made once a shape.
struct SolidShape {
  explicit SolidShape(ShapePtr shape);
  ShapePtr shape;
  bool convex = true;
  std::vector<Plane> planes;         // convex meshes: of the faces, each once
  std::unique_ptr<MeshQuery> query;  // meshes that are not convex, but for tubes
  std::vector<Vec3> points;          // spread over the surface, own frame [m]
};

/// A solid shape at a pose.
class Body {
 public:
  Body(const SolidShape& solid, const Pellet& pellet);

  const SolidShape& solid() const { return *solid_; }
  const Vec3& centre() const { return centre_; }
  double bounding_radius() const { return scale_ * solid_->shape->bounding_radius; }
  double thickness() const { return scale_ * solid_->shape->smallest_thickness; }

  /// A point of the body that is furthest along a direction (of any length), world [m].
  Vec3 furthest(const Vec3& direction) const;
  /// Part of the line origin + t direction (unit) inside a convex body: from, to; from >= to when it misses.
  std::pair<double, double> chord(const Vec3& origin, const Vec3& direction) const;
  /// How deep a point lies under the surface [m]; 0 or less outside.
  double depth(const Vec3& point) const;
  Vec3 to_world(const Vec3& own) const { return centre_ + rotation_ * (scale_ * own); }

 private:
  const SolidShape* solid_;
  double scale_;
  Vec3 centre_;
  Mat3 rotation_;
};

/// Part of the line o + t d (own frame, d unit) inside a cylinder along z; from >= to when it misses.
std::pair<double, double> cylinder_chord(double radius, double half_height, const Vec3& o, const Vec3& d);
/// The same for a sphere.
std::pair<double, double> sphere_chord(double radius, const Vec3& o, const Vec3& d);

}  // namespace packbed
