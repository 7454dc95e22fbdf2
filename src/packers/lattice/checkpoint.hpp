#pragma once
// The state of a run as bytes: poses, and the cells of pellets that wear. All else follows.
#include <cstddef>
#include <span>
#include <vector>

#include "packers/feed.hpp"
#include "packers/lattice/model.hpp"

namespace packbed::lattice {

std::vector<std::byte> save(const Model& model, const State& state, const Feeder& feeder);
/// Into a fresh state. Throws SystemError for bytes that are not the state of a lattice run.
void restore(std::span<const std::byte> bytes, const Model& model, State& state, Feeder& feeder);

}  // namespace packbed::lattice
