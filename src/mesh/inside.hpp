#pragma once
// Questions to a closed mesh: inside, how far, what does a ray meet. Exact predicates (CGAL's tree of boxes),
// so it is the oracle of the faster, inexact answers elsewhere. From 200 to 40,000 triangles a question costs
// 0.5 to 2 us (inside) and 2 to 27 us (distance), see docs/cad.md: for import and tests, not for a time step.
#include <cstddef>
#include <memory>
#include <vector>

#include "mesh/mesh.hpp"

namespace packbed {

struct RayHit {
  double distance = 0;  // along the ray, in units of its direction's length
  std::size_t triangle = 0;
};

class MeshQuery {
 public:
  /// The mesh must be closed, outward and manifold (check_mesh); it is copied.
  explicit MeshQuery(const TriangleMesh& mesh);
  ~MeshQuery();
  MeshQuery(MeshQuery&&) noexcept;
  MeshQuery& operator=(MeshQuery&&) noexcept;

  bool inside(const Vec3& point) const;             ///< on the surface counts as inside
  double signed_distance(const Vec3& point) const;  ///< [m], negative inside
  Vec3 closest_point(const Vec3& point) const;      ///< on the surface [m]
  /// All triangles that the ray from `from` meets, nearest first; one through an edge meets both.
  std::vector<RayHit> ray(const Vec3& from, const Vec3& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Pairs of triangles that cut each other or touch where they share nothing, at most `limit` of them. The
/// mesh must be manifold and without degenerate triangles.
std::vector<std::pair<std::size_t, std::size_t>> self_crossings(const TriangleMesh& mesh, std::size_t limit);

}  // namespace packbed
