#pragma once
// Upright prisms over a plane section, holes and all.
#include <vector>

#include "mesh/mesh.hpp"

namespace packbed {

using Contour = std::vector<Vec2>;  // closed polygon [m], the last point is joined to the first

/// A plane region: inside an odd number of contours, which must neither cross nor touch. Either sense.
struct Section {
  std::vector<Contour> contours;
};

/// Area of a polygon [m2], whatever its sense.
double area_of(const Contour& contour);
/// A regular polygon of the area of the circle [m].
Contour circle_contour(const Vec2& centre, double radius, int sides);
/// The closed mesh of the prism over the section from z = low to z = high [m].
TriangleMesh prism_mesh(const Section& section, double low, double high);

}  // namespace packbed
