#pragma once
// Where the centres of a layer of equal spheres go in a circle.
#include <vector>

#include "math/random.hpp"

namespace packbed {

/// A hexagonal pattern within a circle round the origin: the sites nearest to the origin of a lattice whose
/// offset is chosen so that they fit as loosely as possible.
struct LayerPattern {
  double pitch = 0;         // between neighbouring sites [m]
  std::vector<Vec2> sites;  // [m]; all within the circle
  double shake = 0;  // every site may move so far and none will be nearer than `spacing` to another [m]
};

/// `wanted` sites at least `spacing` apart within `radius`, or as many as there is room for. `loose`: as far
/// apart as possible, then exactly `wanted` (the circle's outermost sites decide the pitch); else as dense
/// and as many as possible.
LayerPattern layer_pattern(double radius, double spacing, int wanted, bool loose);

/// The pattern turned by a random angle, its sites in random order and shaken within the circle.
std::vector<Vec2> shaken(const LayerPattern& pattern, double radius, Random& random);

}  // namespace packbed
