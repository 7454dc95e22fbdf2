#pragma once
// Do large and small pellets lie apart?
#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"

namespace packbed {

/// Correlation of diameter (sphere of equal volume) and place over all pellets.
Segregation segregation(const PackedBed& bed);

}  // namespace packbed
