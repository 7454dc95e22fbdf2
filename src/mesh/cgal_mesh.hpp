#pragma once
// The bridge to CGAL. Included by the two .cpp files that use it and by nothing else: each costs tens of
// seconds to compile.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "mesh/mesh.hpp"

namespace packbed {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

// Faces and vertices keep their numbers. The mesh must be manifold, or faces go missing.
inline CgalMesh to_cgal(const TriangleMesh& mesh) {
  CgalMesh out;
  out.reserve(static_cast<CgalMesh::size_type>(mesh.vertices.size()),
              static_cast<CgalMesh::size_type>(3 * mesh.triangles.size() / 2),
              static_cast<CgalMesh::size_type>(mesh.triangles.size()));
  for (const Vec3& v : mesh.vertices) out.add_vertex({v.x(), v.y(), v.z()});
  const auto vertex = [](std::int32_t i) {
    return CgalMesh::Vertex_index(static_cast<CgalMesh::size_type>(i));
  };
  for (const auto& t : mesh.triangles) out.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  return out;
}

}  // namespace packbed
