#pragma once
// Is this mesh a sphere, a cylinder, a cup? Decided from where its vertices and facets lie, never from a
// name.
#include <optional>

#include "mesh/mesh.hpp"

namespace packbed {

struct SphereFit {
  Vec3 centre;        // [m]
  double radius = 0;  // of the vertices [m]
};
/// A closed mesh whose vertices lie on one sphere and whose facets follow it (kRecogniseTolerance,
/// kRecogniseSag).
std::optional<SphereFit> recognise_sphere(const TriangleMesh& mesh);

struct CylinderFit {
  Vec3 centre, axis;              // [m], unit vector
  double radius = 0, height = 0;  // [m]
  double inner_radius = 0;        // of a hole along the axis [m]; 0: there is none
};
/// A closed mesh of two flat parallel ends and one round side, or two round sides about one axis.
std::optional<CylinderFit> recognise_cylinder(const TriangleMesh& mesh);

struct TubeFit {
  Vec3 floor;                     // centre of the floor's inner face [m]
  double radius = 0, height = 0;  // of the inside, floor to rim [m]
};
/// A closed mesh of the wall of an upright cup (open towards +z): flat round floor, round inner wall, nothing
/// else inside. Its outside may have any form.
std::optional<TubeFit> recognise_tube(const TriangleMesh& mesh);

struct BoxFit {
  Vec3 floor;                               // centre of the floor's inner face [m]
  double width = 0, depth = 0, height = 0;  // of the inside along x, y, z [m]
};
/// A closed mesh of the wall of an upright box (open towards +z) whose sides, inner and outer, stand along x
/// and y.
std::optional<BoxFit> recognise_box(const TriangleMesh& mesh);

}  // namespace packbed
