#pragma once
// A pellet's shape: immutable, made once by one of the make functions, shared by all pellets of its kind.
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/mesh.hpp"

namespace packbed {

/// What the packer may assume. A more special class has a faster, exact kernel.
enum class ShapeClass { sphere, cylinder, mesh };
std::string_view to_string(ShapeClass);

/// In the shape's own frame: centre of mass at the origin, principal axes along x, y, z; a body of revolution
/// has z as its axis.
struct Shape {
  std::string name;    // of the case file
  std::string source;  // file or parametric name that it was made from
  ShapeClass kind = ShapeClass::mesh;
  double radius = 0;       // sphere and cylinder [m]
  double half_height = 0;  // cylinder [m]
  double volume = 0;       // of the body that moves [m3] (of the exact primitive where one was recognised)
  double area = 0;         // [m2]
  Vec3 inertia = Vec3::Zero();  // principal moments for unit density [m5]
  double bounding_radius = 0;   // of the smallest origin-centred sphere that holds it [m]
  double smallest_thickness =
      0;  // thinnest wall, or smallest width of a convex body [m]; overlaps are fractions of it
  TriangleMesh surface;    // closed; volume conserved when a curved body was faceted
  double mesh_volume = 0;  // of the mesh as it was read [m3], before any correction
  Pose from_file;          // file frame to own frame: own = from_file.rotation * (file - from_file.position)
  std::optional<TetMesh> tets;  // own frame; only when asked for

  /// Diameter of the sphere of the same volume [m].
  double equivalent_diameter() const;
};

using ShapePtr = std::shared_ptr<const Shape>;

/// Exact primitives; the surface has `facets` facets round and conserves the volume.
ShapePtr make_sphere(const std::string& name, double radius, int facets = 24);
ShapePtr make_cylinder(const std::string& name, double diameter, double height, int facets = 48);
/// How closely a mesh must follow a primitive to be taken for it: fraction of its size.
inline constexpr double kRecogniseTolerance = 2e-3;
/// From a closed, outward, checked mesh (see mesh/check.hpp). Recognises spheres and cylinders within
/// kRecogniseTolerance unless `recognise` is false; else the mesh itself is the body.
ShapePtr make_shape(const std::string& name, const std::string& source, const TriangleMesh& mesh,
                    bool recognise = true);

}  // namespace packbed
