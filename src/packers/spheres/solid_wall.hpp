#pragma once
// A container that is no more than a mesh: seen by spheres through its depth field, as by the mesh packer.
#include <vector>

#include "contact/field.hpp"
#include "mesh/triangle_tree.hpp"

namespace packbed::spheres {

class SolidWall {
 public:
  /// `shapes`: the sphere kinds; `thinnest`: diameter of the smallest sphere [m].
  SolidWall(const Container& container, const std::vector<ShapePtr>& shapes, double thinnest);

  /// From a sphere's centre to the wall's surface [m]; negative inside the material.
  double distance(const Vec3& centre) const { return tree_.signed_distance(centre); }
  /// Where the wall stands beside a sphere that may touch it: unit normal away from the material, and
  /// distance of the centre [m], at least the radius when they are apart.
  void side(std::uint32_t kind, double scale, double radius, const Vec3& centre, Vec3& normal,
            double& distance) const;

 private:
  TriangleTree tree_;
  std::vector<FieldBody> bodies_;  // one a kind
  FieldWall field_;
};

}  // namespace packbed::spheres
