#include "shape/library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/error.hpp"

namespace packbed {
namespace {

using Maker = ShapePtr (*)(const std::string&, const LibrarySizes&);

const std::vector<std::pair<std::string_view, Maker>> kMakers{
    {"sphere",
     [](const std::string& name, const LibrarySizes& s) { return make_sphere(name, s.diameter / 2); }},
    {"cylinder", [](const std::string& name,
                    const LibrarySizes& s) { return make_cylinder(name, s.diameter, s.height); }},
    {"ring",
     [](const std::string& name, const LibrarySizes& s) {
       return make_ring(name, s.diameter, s.inner_diameter, s.height, circle_sides(s.chord_error));
     }},
    {"star", make_star},
    {"lobed", make_lobed},
    {"holed", make_holed},
    {"dished", make_dished},
    {"box", make_box},
    {"tetrahedron", make_tetrahedron},
    {"ellipsoid", make_ellipsoid}};

}  // namespace

const std::vector<std::string_view>& library_shapes() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> out;
    for (const auto& [name, maker] : kMakers) out.push_back(name);
    return out;
  }();
  return names;
}

ShapePtr make_library_shape(const std::string& name, const std::string& shape, const LibrarySizes& sizes) {
  for (const auto& [known, maker] : kMakers)
    if (shape == known) return maker(name, sizes);
  throw InputError("shape", fmt::format("\"{}\"", shape),
                   fmt::format("{}", fmt::join(library_shapes(), ", ")));
}

int circle_sides(double chord_error) {
  return 4 * static_cast<int>(std::ceil(kPi / std::acos(1 - std::clamp(chord_error, 1e-6, 0.5)) / 4));
}

void require_size(bool holds, std::string_view key, double found, const std::string& allowed) {
  if (!holds) throw InputError(std::string(key), fmt::format("{:.6g} mm", 1e3 * found), allowed);
}

}  // namespace packbed
