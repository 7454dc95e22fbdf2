#pragma once
// Random places for spheres of many sizes that overlap none of the others.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "math/types.hpp"

namespace packbed {

/// A place for each sphere (centres [m]), the largest placed first. `draw(i, try)` gives places for sphere i,
/// nothing where it may not be. Empty when a sphere has found no room in so many `tries`.
std::vector<Vec3> scattered(std::span<const double> radii, int tries,
                            const std::function<std::optional<Vec3>(std::size_t, int)>& draw);

}  // namespace packbed
