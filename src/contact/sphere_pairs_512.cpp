#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(PACKBED_SANITIZED)
#define PACKBED_512
#endif

#ifdef PACKBED_512
// From here on for AVX-512; comparisons have their form from where they are written, so target_clones will
// not do. What comes before must not be: the linker may keep this file's copy of an inline function for all.
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl")
#include "contact/sphere_kernel.hpp"

namespace packbed {
namespace {

void touch_spheres(const SphereWork& work) {
  spheres<Eight>(work);
}
void touch_walls(const SphereWork& work, std::span<const SphereWall> of) {
  walls<Eight>(work, of);
}
void touch_given_walls(const SphereWork& work, std::span<const Quad> sides) {
  given_walls<Eight>(work, sides);
}

}  // namespace
}  // namespace packbed
#pragma GCC pop_options
#endif

#include "contact/sphere_pairs_512.hpp"

namespace packbed {

std::optional<SphereLoops> sphere_loops_512() {
#ifdef PACKBED_512
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return SphereLoops{"eight", touch_spheres, touch_walls, touch_given_walls};
#endif
  return {};
}

}  // namespace packbed
