#include "analysis/axial.hpp"

#include <cmath>
#include <limits>

#include "lattice/count.hpp"

namespace packbed {

SliceCounts count_slices(const VoxelGrid& grid, const VoxelGrid& space) {
  SliceCounts counts{slice_counts(grid, space), slice_counts(space)};
  if (space.frame.size[2] == 1) counts.space.assign(counts.solid.size(), counts.space.front());
  return counts;
}

std::vector<double> axial_profile(const SliceCounts& counts, const Layout& layout) {
  std::vector<double> density;
  const std::vector<double>& edges = layout.axial_edges;
  const auto slice = [&](double z) {
    return static_cast<std::size_t>(std::lround((z - layout.frame.origin.z()) / layout.frame.pitch));
  };
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
    std::int64_t solid = 0, space = 0;
    for (std::size_t z = slice(edges[b]); z < slice(edges[b + 1]); ++z) {
      solid += counts.solid[z];
      space += counts.space[z];
    }
    density.push_back(space ? static_cast<double>(solid) / static_cast<double>(space)
                            : std::numeric_limits<double>::quiet_NaN());
  }
  return density;
}

}  // namespace packbed
