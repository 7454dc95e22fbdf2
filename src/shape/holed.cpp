#include <fmt/format.h>

#include <cmath>

#include "mesh/prism.hpp"
#include "shape/library.hpp"

namespace packbed {

ShapePtr make_holed(const std::string& name, const LibrarySizes& s) {
  const double between = s.hole_circle * std::sin(kPi / s.holes);  // centres of neighbouring holes
  require_size(s.hole_circle + s.hole_diameter < s.diameter, "hole_circle", s.hole_circle,
               fmt::format("less than {:.6g} mm, so that the holes stay inside",
                           1e3 * (s.diameter - s.hole_diameter)));
  require_size(s.holes == 1 || between > s.hole_diameter, "hole_diameter", s.hole_diameter,
               fmt::format("less than {:.6g} mm, so that wall stays between the holes", 1e3 * between));
  const int sides = circle_sides(s.chord_error);
  Section section{{circle_contour(Vec2::Zero(), s.diameter / 2, sides)}};
  for (int k = 0; k < s.holes; ++k) {
    const double angle = 2 * kPi * k / s.holes;
    section.contours.push_back(circle_contour(s.hole_circle / 2 * Vec2(std::cos(angle), std::sin(angle)),
                                              s.hole_diameter / 2, sides));
  }
  return make_shape(
      name,
      fmt::format("cylinder of diameter {:.6g} mm and height {:.6g} mm with {} holes of {:.6g} mm",
                  1e3 * s.diameter, 1e3 * s.height, s.holes, 1e3 * s.hole_diameter),
      prism_mesh(section, -s.height / 2, s.height / 2));
}

}  // namespace packbed
