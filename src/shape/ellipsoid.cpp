#include <fmt/format.h>

#include "shape/library.hpp"

namespace packbed {

// A sphere stretched along its axes; one whose axes are equal is the sphere.
ShapePtr make_ellipsoid(const std::string& name, const LibrarySizes& s) {
  TriangleMesh mesh = make_sphere(name, 0.5, circle_sides(s.chord_error))->surface;
  for (Vec3& p : mesh.vertices) p = p.cwiseProduct(s.size);
  return make_shape(name,
                    fmt::format("ellipsoid of axes {:.6g}, {:.6g} and {:.6g} mm", 1e3 * s.size.x(),
                                1e3 * s.size.y(), 1e3 * s.size.z()),
                    mesh, true, kPi / 6 * s.size.prod());
}

}  // namespace packbed
