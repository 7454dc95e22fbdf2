#include <fmt/format.h>

#include <cmath>

#include "math/error.hpp"
#include "mesh/prism.hpp"
#include "shape/library.hpp"

namespace packbed {
namespace {

// Of one lobe: where its disc lies and where its outline ends.
struct Lobe {
  double radius = 0, away = 0;  // of the disc, and of its centre from the axis [m]
  double cusp = 0;              // where two lobes meet, from the axis [m]
  double turn = 0;              // seen from its centre, from its tip to the cusp [rad]
};

Lobe lobe_of(const LibrarySizes& s) {
  Lobe l{s.lobe_diameter / 2, (s.diameter - s.lobe_diameter) / 2};
  const double half = kPi / s.lobes, aside = l.away * std::sin(half);
  require_size(l.away > 0, "lobe_diameter", s.lobe_diameter,
               fmt::format("less than the diameter, {:.6g} mm", 1e3 * s.diameter));
  require_size(aside < l.radius, "lobe_diameter", s.lobe_diameter,
               fmt::format("more than {:.6g} mm, so that the lobes meet",
                           1e3 * s.diameter * std::sin(half) / (1 + std::sin(half))));
  l.cusp = l.away * std::cos(half) + std::sqrt(l.radius * l.radius - aside * aside);
  l.turn = std::atan2(l.cusp * std::sin(half), l.cusp * std::cos(half) - l.away);
  return l;
}

// Half a lobe is the triangle of axis, centre and cusp, and a sector of the disc.
double section_area(const Lobe& l, int lobes) {
  const double triangle = l.away * l.cusp * std::sin(kPi / lobes) / 2;
  return 2 * lobes * (triangle + l.radius * l.radius * l.turn / 2);
}

}  // namespace

ShapePtr make_lobed(const std::string& name, const LibrarySizes& s) {
  const Lobe l = lobe_of(s);
  const int steps = std::max(2, static_cast<int>(std::ceil(circle_sides(s.chord_error) * l.turn / kPi)));
  Contour outline;
  for (int k = 0; k < s.lobes; ++k) {
    const double middle = 2 * kPi * k / s.lobes;
    for (int i = 0; i < steps; ++i) {
      const double angle = middle - l.turn + 2 * l.turn * i / steps;
      outline.emplace_back(l.away * std::cos(middle) + l.radius * std::cos(angle),
                           l.away * std::sin(middle) + l.radius * std::sin(angle));
    }
  }
  const double area = section_area(l, s.lobes), stretch = std::sqrt(area / area_of(outline));
  for (Vec2& p : outline) p *= stretch;
  return make_shape(name,
                    fmt::format("{} lobes of {:.6g} mm, diameter {:.6g} mm, height {:.6g} mm", s.lobes,
                                1e3 * s.lobe_diameter, 1e3 * s.diameter, 1e3 * s.height),
                    prism_mesh({{outline}}, -s.height / 2, s.height / 2), true, area * s.height);
}

}  // namespace packbed
