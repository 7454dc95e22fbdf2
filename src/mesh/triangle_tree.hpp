#pragma once
// Signed distance from a closed mesh, quickly: for sampling fields at millions of nodes. MeshQuery
// (mesh/inside.hpp) is its slower, exact oracle.
#include <array>
#include <limits>
#include <vector>

#include "mesh/mesh.hpp"

namespace packbed {

class TriangleTree {
 public:
  /// The mesh must be closed, outward and manifold (check_mesh).
  explicit TriangleTree(const TriangleMesh& mesh);

  struct Nearest {
    double distance = 0;         // [m], negative inside
    Vec3 point = Vec3::Zero();   // on the surface [m]
    std::int32_t triangle = -1;  // -1: nothing within the bound
  };
  /// The nearest point of the surface, if it is nearer than `bound` [m]. The sign is that of the
  /// angle-weighted normal of the face, edge or corner that is nearest (Baerentzen & Aanaes, IEEE TVCG 11
  /// (2005) 243), which is exact for closed meshes.
  Nearest nearest(const Vec3& p, double bound = std::numeric_limits<double>::infinity()) const;
  double signed_distance(const Vec3& p) const { return nearest(p).distance; }
  /// Every place of the surface that is nearer to p than all of the surface round it, and nearer than `bound`
  /// [m]: one on a flat face, however it is cut into triangles, three in a corner of a room. Only those that
  /// p faces; inside of the mesh, the nearest alone. In place of what `places` holds, nearest first.
  void nearest_places(const Vec3& p, double bound, std::vector<Nearest>& places) const;

 private:
  struct Node {
    Box3 box;
    std::int32_t first = 0, count = 0;  // of triangles in a leaf; of the left child in a branch (count 0)
  };
  struct Triangle {
    Vec3 a, b, c;
    std::int32_t index = 0;
  };
  void split(std::int32_t node, std::vector<Triangle>& triangles);
  template <class Visit>
  void visit_within(const Vec3& p, double& bound2, const Visit& visit) const;
  double sign_at(const Vec3& from_surface, std::int32_t triangle, int feature) const;

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;          // in the order of the leaves
  std::vector<std::array<Vec3, 7>> normal_;  // of face, edges ab, bc, ca, corners a, b, c, not normalised
};

}  // namespace packbed
