#pragma once
// Spheres that have settled stand still until something would move them: see sleep.cpp.
#include "packers/spheres/model.hpp"

namespace packbed::spheres {

/// Makes room for the sphere that has entered last.
void add_sleeper(const Model& model, State& state);

/// A pair of sphere i with something that moves is listed from now on.
inline void come_to_shore(Sleepers& sleepers, std::size_t i) {
  if (sleepers.is[i] == Sleepers::kAwake) return;
  sleepers.is[i] = Sleepers::kShore;
  sleepers.other_pairs[i] = 1;
}
/// All lists are new.
void find_shore(State& state);

/// Ends all sleep. Forces have to be whole.
void wake_all(const Model& model, State& state);

}  // namespace packbed::spheres
