#pragma once
// Which sizes a bed has, against which it was asked to have.
#include <cstddef>
#include <vector>

#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"
#include "bed/scene.hpp"

namespace packbed {

/// Of each shape that has pellets of more than one size: its sizes, largest first, when there are no more
/// than kMostSizes; else classes between the smallest and the largest, evenly in the logarithm.
std::vector<SizeRow> size_rows(const PackedBed& bed);
inline constexpr std::size_t kMostSizes = 32, kSizeClasses = 16;

/// Row of a pellet; rows.size() when it has none.
std::size_t row_of(const std::vector<SizeRow>& rows, const PackedBed& bed, const Pellet& pellet);

/// Adds what the case asks for. Sizes asked for that no pellet has become rows without pellets.
void add_asked(std::vector<SizeRow>& rows, const std::vector<PelletKind>& kinds);

}  // namespace packbed
