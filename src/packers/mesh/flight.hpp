#pragma once
// Bodies in free flight, far from everything: they leap in closed form from one search to the next, cost
// nothing in between and do not trigger searches.
#include "packers/mesh/model.hpp"

namespace packbed::mesh {

/// Finds when body i, just entered, may meet the wall or others in flight.
void begin_flight(const Model& model, State& state, std::size_t i);
/// Brings airborne bodies to the present time.
void catch_up(const Model& model, State& state);
/// Ends the flights that may end within `horizon` [s] and finds the time of the next landing.
void land(const Model& model, State& state, double horizon);

}  // namespace packbed::mesh
