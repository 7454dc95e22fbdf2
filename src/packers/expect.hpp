#pragma once
// What can be told of a run before it starts, from the scene alone.
#include <string>
#include <utility>

#include "bed/scene.hpp"

namespace packbed {

/// The smallest and the largest scale that pellets of a kind will have.
std::pair<double, double> scales_of(const Scene& scene, std::uint32_t kind);
/// Highest speed that a pellet can have when it lands [m/s].
double landing_speed(const Scene& scene);
/// The speed of impact that contacts have to stand [m/s]: that of landing, and at least 0.1 m/s, as a bed
/// that is only placed still has to carry itself.
double hardest_impact(const Scene& scene);
/// The step of the scene [s], from the time of its stiffest contact. Throws InputError, with `fix` as the way
/// out, for one that the explicit scheme cannot take.
double step_for(const Scene& scene, double contact, const std::string& fix);
/// Simulated time until rest [s], roughly: for the progress line.
double expected_time(const Scene& scene);

}  // namespace packbed
