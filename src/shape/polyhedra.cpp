#include <fmt/format.h>

#include <cmath>

#include "mesh/build.hpp"
#include "shape/library.hpp"

namespace packbed {

ShapePtr make_box(const std::string& name, const LibrarySizes& s) {
  return make_shape(
      name,
      fmt::format("box of {:.6g} x {:.6g} x {:.6g} mm", 1e3 * s.size.x(), 1e3 * s.size.y(), 1e3 * s.size.z()),
      box_mesh(-s.size / 2, s.size / 2));
}

ShapePtr make_tetrahedron(const std::string& name, const LibrarySizes& s) {
  const double radius = s.edge / std::sqrt(3.0), height = s.edge * std::sqrt(2.0 / 3);
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0, 0, 0.75 * height);  // the centre of mass is a quarter of the way up
  for (int k = 0; k < 3; ++k)
    mesh.vertices.emplace_back(radius * std::cos(2 * kPi * k / 3), radius * std::sin(2 * kPi * k / 3),
                               -0.25 * height);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  return make_shape(name, fmt::format("tetrahedron of edge {:.6g} mm", 1e3 * s.edge), mesh);
}

}  // namespace packbed
