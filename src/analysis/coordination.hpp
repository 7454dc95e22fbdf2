#pragma once
// How many others a pellet touches.
#include <optional>

#include "analysis/core.hpp"
#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"

namespace packbed {

/// From the packer's contacts (those that push), or from the overlaps of a bed that has none. A pellet with
/// fewer than four contacts, the container's counted, is a rattler: without friction nothing less can hold
/// it. `rows` are those of size_rows(); `core` may be empty.
Coordination coordination(const PackedBed& bed, const std::vector<Overlap>& overlaps,
                          const std::vector<SizeRow>& rows, const std::optional<CoreRegion>& core);

}  // namespace packbed
