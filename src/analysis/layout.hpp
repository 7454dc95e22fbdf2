#pragma once
// Where a bed is measured, settled once for all analyses: pellet diameter, middle section, bins.
#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"
#include "bed/scene.hpp"
#include "lattice/voxel_grid.hpp"

namespace packbed {

struct Section {
  double from = 0, to = 0;  // above the floor [m]
  bool clipped = false;     // the bed was too low for the section asked for
};

/// From wish.from_diameters to wish.to_diameters above the floor when the bed reaches so high. Else from
/// there, or from a quarter of its height where that is lower, to two diameters under its top; and the middle
/// half of a bed that leaves less than one diameter between these.
Section middle_section(double top, double diameter, const AnalysisWish& wish);

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

/// dp: as wished, else the diameter of the sphere of the pellets' mean volume [m]; 0 for an empty bed.
double pellet_diameter(const PackedBed& bed, const AnalysisWish& wish);

}  // namespace packbed
