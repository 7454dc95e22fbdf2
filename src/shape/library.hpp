#pragma once
// The shapes that a case names with their sizes instead of a file; one .cpp a family. All sizes in metres;
// docs/shapes.md draws them. Each maker throws InputError that names the size when sizes do not fit together.
// What is curved is faceted no deeper than chord_error (fraction of the radius) and keeps its volume.
#include <string>
#include <string_view>
#include <vector>

#include "shape/shape.hpp"

namespace packbed {

/// Of a shape of the library; a shape reads those that it has.
struct LibrarySizes {
  double diameter = 0;        // of the circle, or sphere, round it [m]
  double height = 0;          // [m]
  double inner_diameter = 0;  // ring: of the hole; star: of the circle through the valleys [m]
  int points = 0;             // star
  int lobes = 0;              // lobed
  double lobe_diameter = 0;   // lobed [m]
  int holes = 0;              // holed
  double hole_diameter = 0;   // holed [m]
  double hole_circle = 0;     // holed: diameter of the circle through the holes' centres [m]
  double dish_diameter = 0;   // dished: of the rim of the dishes [m]
  double dish_depth = 0;      // dished [m]
  double edge = 0;            // tetrahedron [m]
  Vec3 size = Vec3::Zero();   // box: edges; ellipsoid: axes, from end to end [m]
  double chord_error = 2e-3;  // fraction of the radius
};

/// Names that make_library_shape knows, in the order of the documentation.
const std::vector<std::string_view>& library_shapes();
ShapePtr make_library_shape(const std::string& name, const std::string& shape, const LibrarySizes& sizes);

/// Cylinder of a section with `points` points: corners on circles of two diameters in turn.
ShapePtr make_star(const std::string& name, const LibrarySizes& sizes);
/// Cylinder whose section is `lobes` round discs that overlap, and the polygon of their centres.
ShapePtr make_lobed(const std::string& name, const LibrarySizes& sizes);
/// Cylinder with `holes` round holes on a circle, the first towards x.
ShapePtr make_holed(const std::string& name, const LibrarySizes& sizes);
/// Cylinder with a spherical dish in both ends.
ShapePtr make_dished(const std::string& name, const LibrarySizes& sizes);
ShapePtr make_box(const std::string& name, const LibrarySizes& sizes);
ShapePtr make_tetrahedron(const std::string& name, const LibrarySizes& sizes);
ShapePtr make_ellipsoid(const std::string& name, const LibrarySizes& sizes);

/// Sides of a circle whose chords lie no deeper than chord_error under it; a multiple of four, so that the
/// body keeps its planes of symmetry.
int circle_sides(double chord_error);
/// Refuses unless `holds`: "found" and "allowed" of the key.
void require_size(bool holds, std::string_view key, double found, const std::string& allowed);

}  // namespace packbed
