#pragma once
// The whole state of a run as bytes, so that a run continued from them goes on bit for bit.
#include <cstddef>
#include <span>
#include <vector>

#include "packers/feed.hpp"
#include "packers/spheres/model.hpp"

namespace packbed::spheres {

std::vector<std::byte> save(const State& state, const Feeder& feeder);
/// Throws SystemError when the bytes are not such a state.
void restore(std::span<const std::byte> bytes, State& state, Feeder& feeder);

}  // namespace packbed::spheres
