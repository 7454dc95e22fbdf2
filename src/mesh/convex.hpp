#pragma once
// Convex polyhedra by their planes.
#include <vector>

#include "mesh/mesh.hpp"

namespace packbed {

/// x is inside where normal . x <= offset.
struct Plane {
  Vec3 normal = Vec3::UnitZ();  // outward, unit
  double offset = 0;            // [m]
};

/// Planes of the faces of a closed outward mesh, largest facet first, coplanar triangles once; empty when the
/// mesh is not convex. Corners may lie off a plane by kPlaneTolerance.
std::vector<Plane> convex_planes(const TriangleMesh& mesh);

/// What single precision leaves of a plane, fraction of the mesh's diagonal: finer, and the facets of a flat
/// face of an STL file become many planes; coarser, and the facets of fine round bodies become one.
inline constexpr double kPlaneTolerance = 1e-6;

/// The vertices that lie on three planes or more: corners of the polyhedron, without those in its faces.
std::vector<Vec3> polyhedron_corners(const TriangleMesh& mesh, const std::vector<Plane>& planes);

}  // namespace packbed
