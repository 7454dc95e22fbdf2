#pragma once
// Where a bed is measured, settled once for all analyses: pellet diameter, middle section, bins.
#include "analysis/results.hpp"
#include "bed/section.hpp"
#include "lattice/voxel_grid.hpp"

namespace packbed {

struct Layout {
  GridFrame frame;
  double diameter = 0;                 // dp of all scaled axes [m]
  double top = 0;                      // of the bed [m]
  double radius = 0;                   // of the round inside [m]; 0: none, so there is no radial profile
  Section section;                     // moved to the nearest slice boundaries of the frame
  int slice_begin = 0, slice_end = 0;  // of the frame, in the section
  std::vector<double> axial_edges, ring_edges;  // of the bins: height, distance from the wall [m]
};

/// Bins of all profiles are as wide as the whole number of voxels nearest to dp / 40, at least one voxel.
Layout lay_out(const GridFrame& frame, double top, double diameter, double radius, const AnalysisWish& wish);

}  // namespace packbed
