#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/build.hpp"
#include "shape/library.hpp"

namespace packbed {

ShapePtr make_dished(const std::string& name, const LibrarySizes& s) {
  const double r = s.diameter / 2, h = s.height / 2, rim = s.dish_diameter / 2, depth = s.dish_depth;
  require_size(rim < r, "dish_diameter", s.dish_diameter,
               fmt::format("less than the diameter, {:.6g} mm", 1e3 * s.diameter));
  require_size(depth < h && depth <= rim, "dish_depth", depth,
               fmt::format("less than half of the height, {:.6g} mm, and no more than half of dish_diameter",
                           1e3 * h));
  const double ball = (rim * rim + depth * depth) / (2 * depth);  // radius of the sphere
  const double turn = std::atan2(rim, ball - depth);              // from the dish's middle to its rim
  const int sides = circle_sides(s.chord_error),
            steps = std::max(2, static_cast<int>(std::ceil(sides * turn / (2 * kPi))));
  std::vector<std::pair<double, double>> dish;  // from the middle to the rim: (r, how deep)
  for (int i = 0; i <= steps; ++i) {
    const double angle = turn * i / steps;
    dish.emplace_back(ball * std::sin(angle), depth - ball * (1 - std::cos(angle)));
  }
  std::vector<std::pair<double, double>> profile;
  for (const auto& [x, d] : dish) profile.emplace_back(x, d - h);
  profile.insert(profile.end(), {{r, -h}, {r, h}});
  std::reverse(dish.begin(), dish.end());
  for (const auto& [x, d] : dish) profile.emplace_back(x, h - d);
  TriangleMesh mesh = revolved(profile, sides);
  const double cap = kPi * depth / 6 * (3 * rim * rim + depth * depth),
               volume = kPi * r * r * 2 * h - 2 * cap;
  const double stretch = std::sqrt(volume / mass_properties(mesh).volume);  // the ends stay where they are
  for (Vec3& p : mesh.vertices) p.head<2>() *= stretch;
  return make_shape(name,
                    fmt::format("cylinder of diameter {:.6g} mm and height {:.6g} mm, ends dished {:.6g} mm",
                                1e3 * s.diameter, 1e3 * s.height, 1e3 * depth),
                    mesh, true, volume);
}

}  // namespace packbed
