#pragma once
// Meshes as plain records. Lengths in metres.
#include <array>
#include <cstdint>
#include <vector>

#include "math/types.hpp"

namespace packbed {

struct TriangleMesh {
  std::vector<Vec3> vertices;  // [m] (n)
  std::vector<std::array<std::int32_t, 3>>
      triangles;  // vertex indices, counter-clockwise seen from outside (m)
};

struct TetMesh {
  std::vector<Vec3> vertices;                     // [m] (n)
  std::vector<std::array<std::int32_t, 4>> tets;  // vertex indices, positive volume (m)
};

/// Of a closed mesh filled with unit density, exact for the polyhedron (divergence theorem).
struct MassProperties {
  double volume = 0;            // [m3]
  double area = 0;              // [m2]
  Vec3 centre = Vec3::Zero();   // centre of mass [m]
  Mat3 inertia = Mat3::Zero();  // about the centre of mass, unit density [m5]
};

/// Sums are taken about the middle of the bounding box and compensated: where the file put its origin costs
/// no digits. Volume is negative for a mesh that is inside out; centre and inertia are then still those of
/// the body. (Moments of a tetrahedron: Tonon, J. Math. Stat. 1 (2004) 8.)
MassProperties mass_properties(const TriangleMesh& mesh);
MassProperties mass_properties(const TetMesh& mesh);
/// Triangles that bound the tetrahedra, seen from outside counter-clockwise; vertices inside are left out.
TriangleMesh boundary(const TetMesh& mesh);
Box3 bounding_box(const TriangleMesh& mesh);
/// The mesh scaled and moved: x -> rotation * (scale * x) + translation.
TriangleMesh transformed(const TriangleMesh& mesh, double scale, const Quat& rotation,
                         const Vec3& translation);

}  // namespace packbed
