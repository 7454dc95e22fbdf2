#pragma once
// A pellet's shape: immutable, made once by one of the make functions, shared by all pellets of its kind.
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/convex.hpp"
#include "mesh/mesh.hpp"

namespace packbed {

/// What the packer may assume. A more special class has a faster, exact kernel.
enum class ShapeClass {
  sphere,
  cylinder,
  mesh,
  tube,   // a cylinder with a round hole along its axis
  convex  // a convex polyhedron
};
std::string_view to_string(ShapeClass);
/// Whether the triangles say where the body is, for code that has no closed form of tubes and polyhedra.
constexpr bool seen_as_mesh(ShapeClass kind) {
  return kind != ShapeClass::sphere && kind != ShapeClass::cylinder;
}

/// A convex body of more planes is as good as round and stays a mesh: all Platonic and Archimedean solids
/// have at most 92.
inline constexpr std::size_t kMostPlanes = 128;
/// Fraction of the size across. Walls under it let bodies through at speeds that thicker ones stop.
inline constexpr double kThinWalled = 0.1;

/// In the shape's own frame: centre of mass at the origin, principal axes along x, y, z; a body of revolution
/// has z as its axis.
struct Shape {
  std::string name;    // of the case file
  std::string source;  // file or parametric name that it was made from
  ShapeClass kind = ShapeClass::mesh;
  double radius = 0;        // sphere, cylinder, and tube's outside [m]
  double inner_radius = 0;  // tube [m]
  double half_height = 0;   // cylinder and tube [m]
  double volume = 0;        // of the body that moves [m3] (of the exact primitive where one was recognised)
  double area = 0;          // [m2]
  Vec3 inertia = Vec3::Zero();  // principal moments for unit density [m5]
  double bounding_radius = 0;   // of the smallest origin-centred sphere that holds it [m]
  double smallest_thickness =
      0;  // thinnest wall, or smallest width of a convex body [m]; overlaps are fractions of it
  std::vector<Plane> planes;  // convex: of the faces, each once; at most kMostPlanes
  std::vector<Vec3> corners;  // convex: where three planes or more meet, each once [m]
  TriangleMesh surface;       // closed; volume conserved when a curved body was faceted
  double mesh_volume = 0;     // of the mesh as it was read [m3], before any correction
  Pose from_file;  // file frame to own frame: own = from_file.rotation * (file - from_file.position)
  std::optional<TetMesh> tets;  // own frame; only when asked for

  /// Diameter of the sphere of the same volume [m].
  double equivalent_diameter() const;
  /// Whether its smallest thickness is under kThinWalled of its size across.
  bool thin_walled() const { return smallest_thickness < kThinWalled * 2 * bounding_radius; }
};

using ShapePtr = std::shared_ptr<const Shape>;

/// Exact primitives; the surface has `facets` facets round and conserves the volume.
ShapePtr make_sphere(const std::string& name, double radius, int facets = 24);
ShapePtr make_cylinder(const std::string& name, double diameter, double height, int facets = 48);
/// A cylinder with a round hole along its axis: ShapeClass::tube. InputError for a hole as wide as it.
ShapePtr make_ring(const std::string& name, double diameter, double inner_diameter, double height,
                   int facets = 48);
/// How closely the vertices of a mesh must follow a primitive to be taken for it: fraction of its size.
inline constexpr double kRecogniseTolerance = 2e-3;
/// How deep facets may lie under the curved surface that their corners lie on, fraction of its radius. A
/// regular polygon of nine sides is taken for a circle, one of eight is a polygon; no regular or Archimedean
/// solid passes for a sphere. Where the CAD kernel gave a volume it decides besides.
inline constexpr double kRecogniseSag = 0.065;
/// From a closed, outward, checked mesh of one solid (see mesh/check.hpp). Recognises spheres, cylinders and
/// tubes within kRecogniseTolerance, and convex polyhedra, unless `recognise` is false; else the mesh itself
/// is the body. Corners of a faceted curved surface lie on it, so a recognised primitive has the size of its
/// corners and more volume than the mesh; its `surface` is stretched about the centre (cylinder and tube:
/// square to the axis) until it has the primitive's volume. `true_volume` [m3]: of the exact body, from the
/// CAD kernel; 0 where nobody knows. A mesh that is its own body is then scaled about its centre of mass to
/// that volume. InputError for a mesh without volume.
ShapePtr make_shape(const std::string& name, const std::string& source, const TriangleMesh& mesh,
                    bool recognise = true, double true_volume = 0);
/// Fills planes and corners of a convex polyhedron from its surface. False, and nothing filled, when the
/// surface is not convex or has more than kMostPlanes planes.
bool find_planes(Shape& shape);
/// Gives a shape the tetrahedra of a mesh in the same file frame, scaled like its surface.
ShapePtr with_tets(const Shape& shape, const TetMesh& tets);

}  // namespace packbed
