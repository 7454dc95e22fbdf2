#pragma once
// Pairs of the field kernel: each of their patches has its own forces and memory.
#include "packers/mesh/model.hpp"

namespace packbed::mesh {

/// Looks at pair p of bodies whose travel adds up to `travelled`.
void look_at_patches(const Model& model, State& state, std::uint32_t p, double travelled);

}  // namespace packbed::mesh
