#include "contact/sphere_pairs.hpp"

#include <vector>

#include "contact/sphere_kernel.hpp"
#include "contact/sphere_pairs_512.hpp"
#include "math/simd.hpp"

namespace packbed {
namespace {

PACKBED_WIDE void touch_spheres(const SphereWork& work) {
  spheres<Four>(work);
}
PACKBED_WIDE void touch_walls(const SphereWork& work, std::span<const SphereWall> of) {
  walls<Four>(work, of);
}
PACKBED_WIDE void touch_given_walls(const SphereWork& work, std::span<const Quad> sides) {
  given_walls<Four>(work, sides);
}

}  // namespace

std::span<const SphereLoops> sphere_loops() {
  static const std::vector<SphereLoops> loops = [] {
    std::vector<SphereLoops> all{{"four", touch_spheres, touch_walls, touch_given_walls}};
    if (const auto eight = sphere_loops_512()) all.push_back(*eight);
    return all;
  }();
  return loops;
}

}  // namespace packbed
