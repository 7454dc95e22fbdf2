#pragma once
// A container that is no more than a mesh, as spheres meet it. What is exact for one flat face is taken for
// every place of the surface that is nearest to the sphere's centre among its surroundings: the depths there,
// in a corner three, go together as those of one touch of the mesh packer do (contact/touch.hpp).
#include "mesh/triangle_tree.hpp"
#include "shape/container.hpp"

namespace packbed::spheres {

class SolidWall {
 public:
  explicit SolidWall(const Container& container) : tree_(container.surface) {}

  /// From a sphere's centre to the wall's surface [m]; negative inside the material.
  double distance(const Vec3& centre) const { return tree_.signed_distance(centre); }
  /// Where the wall stands beside a sphere that may touch it: unit normal away from the material, and
  /// distance of the centre [m], at least the radius when they are apart.
  void side(double radius, const Vec3& centre, Vec3& normal, double& distance) const;

 private:
  TriangleTree tree_;
};

}  // namespace packbed::spheres
