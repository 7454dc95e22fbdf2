#pragma once
// The loops of sphere_pairs.hpp with eight pairs side by side, for AVX-512 (F, DQ and VL).
#include <optional>

#include "contact/sphere_pairs.hpp"

namespace packbed {

/// Nothing where the machine cannot run them. They give the same bytes as those of four.
std::optional<SphereLoops> sphere_loops_512();

}  // namespace packbed
