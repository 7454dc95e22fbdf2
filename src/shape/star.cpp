#include <fmt/format.h>

#include <cmath>

#include "mesh/prism.hpp"
#include "shape/library.hpp"

namespace packbed {

ShapePtr make_star(const std::string& name, const LibrarySizes& s) {
  require_size(s.inner_diameter < s.diameter, "inner_diameter", s.inner_diameter,
               fmt::format("less than the diameter, {:.6g} mm", 1e3 * s.diameter));
  Contour outline;
  for (int k = 0; k < 2 * s.points; ++k) {
    const double r = (k % 2 == 0 ? s.diameter : s.inner_diameter) / 2, angle = kPi * k / s.points;
    outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return make_shape(name,
                    fmt::format("star of {} points, diameters {:.6g} and {:.6g} mm, height {:.6g} mm",
                                s.points, 1e3 * s.diameter, 1e3 * s.inner_diameter, 1e3 * s.height),
                    prism_mesh({{outline}}, -s.height / 2, s.height / 2));
}

}  // namespace packbed
