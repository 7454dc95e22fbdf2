#pragma once
// Where a pellet may be at the start: inside the container, clear of the others.
#include <memory>
#include <span>
#include <vector>

#include "bed/scene.hpp"
#include "mesh/triangle_tree.hpp"
#include "packers/overlap_test.hpp"

namespace packbed {

/// Farthest point of a pellet from the z axis [m], exact for spheres and cylinders, of the vertices for
/// meshes.
double radial_extent(const Shape& shape, double scale, const Pose& pose);
/// Lowest point of a pellet [m].
double lowest_point(const Shape& shape, double scale, const Pose& pose);

/// The inside of a container.
class Room {
 public:
  explicit Room(const Container& container);
  ~Room();

  /// Whether a sphere lies wholly inside, above the floor and clear of the wall. Free space holds everything;
  /// a tube or a box has no lid and no end above its rim.
  bool holds_sphere(const Vec3& centre, double radius) const;
  /// How far a pellet reaches into the floor or wall [m], 0 when clear. In a mesh container of the vertices
  /// of its surface (of a sphere exactly).
  double overlap(const Shape& shape, double scale, const Pose& pose) const;

 private:
  ContainerKind kind_;
  double radius_, half_width_, half_depth_;
  std::unique_ptr<const TriangleTree> wall_;  // of a mesh container
};

/// Throws InputError, naming ids, when placed pellets overlap one another (unless both are fixed) or the
/// container by more than the scene allows: the larger of the contact's allowed overlap and the audit's
/// limit.
void check_placed(const Scene& scene, const OverlapTest& test, const Room& room,
                  std::span<const Pellet> pellets);

}  // namespace packbed
