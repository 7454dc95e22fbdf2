#pragma once
// What can be told of a run before it starts, from the scene alone.
#include "bed/scene.hpp"

namespace packbed {

/// Highest speed that a pellet can have when it lands [m/s].
double landing_speed(const Scene& scene);
/// Simulated time until rest [s], roughly: for the progress line.
double expected_time(const Scene& scene);

}  // namespace packbed
