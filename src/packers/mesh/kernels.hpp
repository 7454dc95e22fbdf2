#pragma once
// Which kernel answers for which pair.
#include "contact/touch.hpp"
#include "packers/mesh/model.hpp"

namespace packbed::mesh {

/// The touch of body a with body b, or with the container. When they are apart, gap is a lower bound of the
/// way that their surfaces must go before they can touch [m].
Touch touch_pair(const Model& model, const Bodies& bodies, std::uint32_t a, std::uint32_t b, double& gap);

}  // namespace packbed::mesh
