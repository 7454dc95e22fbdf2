#pragma once
// Packing density of the middle section, and the sentence that says what that is.
#include <string>

#include "analysis/axial.hpp"

namespace packbed {

/// Solid over inside voxels of the middle section.
double density_of_section(const SliceCounts& counts, const Layout& layout);

/// Standard deviation of those values of an axial profile whose bins lie in the middle section: the spread
/// within one bed, not between beds.
double sd_in_section(const std::vector<double>& values, const Layout& layout);

/// One sentence from the numbers at hand: which volume over which space, region, bins, voxel.
std::string definition_of_density(const Layout& layout, const Container& container, bool voxels);

}  // namespace packbed
