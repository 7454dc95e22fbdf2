#pragma once
// The run of digidem.
#include <span>

#include "packers/packer.hpp"

namespace packbed::lattice {

PackResult pack_digidem(const Scene& scene, const Watch& watch, std::span<const std::byte> state);

}  // namespace packbed::lattice
