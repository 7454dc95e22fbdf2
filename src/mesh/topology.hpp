#pragma once
// How the triangles of a mesh hang together: edges, pieces, orientation. Plain loops over sorted edges, so
// the order of everything is that of the file.
#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"

namespace packbed {

inline const Vec3& corner(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& triangle, int i) {
  return mesh.vertices[static_cast<std::size_t>(triangle[static_cast<std::size_t>(i)])];
}
/// Half the cross product of two sides: outward, as long as the triangle is large [m2].
inline Vec3 triangle_area_vector(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t) {
  return 0.5 * (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0));
}
inline Vec3 triangle_centre(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t) {
  return (corner(mesh, t, 0) + corner(mesh, t, 1) + corner(mesh, t, 2)) / 3;
}

/// One side of one triangle.
struct EdgeUse {
  std::int32_t low = 0, high = 0;  // vertices, low < high
  std::int32_t triangle = 0;
  bool forward = true;  // the triangle runs from low to high
};
/// All sides of all triangles, those of the same edge in a row. (3 a triangle)
std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh);

/// From this angle on an edge is one; below, it is tessellation.
inline constexpr double kSharpAngle = 25 * kPi / 180;
struct MeshEdge {
  std::int32_t low = 0, high = 0;    // vertices, low < high
  std::int32_t left = 0, right = 0;  // triangles
  double angle = 0;                  // by which the surface turns, positive when convex [rad]
};
/// The edges between two triangles of an outward mesh.
std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh);
/// From its lower vertex to its higher one [m].
template <class Edge>
Vec3 edge_vector(const TriangleMesh& mesh, const Edge& e) {
  return mesh.vertices[static_cast<std::size_t>(e.high)] - mesh.vertices[static_cast<std::size_t>(e.low)];
}

struct Pieces {
  std::vector<std::int32_t> of_triangle;  // which piece, counted in the order of the triangles
  int count = 0;
};
/// Parts of a mesh that are connected through edges.
Pieces pieces(const TriangleMesh& mesh);
/// Each piece with the vertices that it uses.
std::vector<TriangleMesh> split(const TriangleMesh& mesh, const Pieces& pieces);

/// Turns triangles so that neighbours agree, each piece as its first triangle has it. Returns how many were
/// turned, or -1 when a piece has but one side (as a Möbius strip) or an edge has more than two triangles.
std::int64_t orient_alike(TriangleMesh& mesh);
/// How many of the other closed pieces hold each piece: even for material, odd for a hole in it. The pieces
/// must not cross.
std::vector<int> depths(const std::vector<TriangleMesh>& pieces);
/// Turns a closed mesh that crosses nothing so that it bounds a solid, whatever way its triangles ran:
/// outermost pieces outward, holes in them inward. False when that is not possible (see orient_alike).
bool orient_outward(TriangleMesh& mesh);
/// Turns every triangle over.
void turn_over(TriangleMesh& mesh);

/// How often the mesh winds round a point: 1 inside a closed outward mesh, 0 outside (Jacobson, Kavan and
/// Sorkine, ACM Trans. Graph. 32 (2013) 33; solid angles after Van Oosterom and Strackee, IEEE Trans. Biomed.
/// Eng. 30 (1983) 125). Time grows with the number of triangles: for a few points only.
double winding_number(const TriangleMesh& mesh, const Vec3& point);

}  // namespace packbed
