#pragma once
// Do two pellets overlap? For entry into a scene, not for forces: exact yes or no for spheres, cylinders and
// convex meshes (GJK), bounding spheres for the rest.
#include <memory>
#include <vector>

#include "bed/packed_bed.hpp"
#include "bed/scene.hpp"

namespace packbed {

class OverlapTest {
 public:
  /// Pellet::shape indexes `kinds`.
  explicit OverlapTest(const std::vector<PelletKind>& kinds);
  ~OverlapTest();

  /// True when they share a point. A mesh that is not convex is taken for its bounding sphere.
  bool overlap(const Pellet& a, const Pellet& b) const;
  /// Penetration depth [m], 0 when apart; about 1 % right while it is small against the pellet. Bounding
  /// spheres are never used: 0 when one of the two is a mesh that is not convex (see exact()).
  double depth(const Pellet& a, const Pellet& b) const;
  /// Whether depth() knows pellets of this shape.
  bool exact(std::uint32_t shape) const;
  double bounding_radius(const Pellet& pellet) const;  ///< [m]

 private:
  struct Body;
  std::vector<std::unique_ptr<Body>> bodies_;  // one a kind
};

}  // namespace packbed
