#pragma once
// The middle section of a bed, where its bulk density is measured.
#include "bed/packed_bed.hpp"
#include "bed/scene.hpp"

namespace packbed {

struct Section {
  double from = 0, to = 0;  // above the floor [m]
  bool clipped = false;     // the bed was too low for the section asked for
};

/// From wish.from_diameters to wish.to_diameters above the floor when the bed reaches so high. Else from
/// there, or from a quarter of its height where that is lower, to two diameters under its top; and the middle
/// half of a bed that leaves less than one diameter between these.
Section middle_section(double top, double diameter, const AnalysisWish& wish);

/// dp: as wished, else the diameter of the sphere of the pellets' mean volume [m]; 0 for an empty bed.
double pellet_diameter(const PackedBed& bed, const AnalysisWish& wish);

/// Solid over open volume of the middle section, from voxels of wish.voxel (docs/results.md,
/// bed.packing_density). Of a bed in a container with sides.
double middle_density(const PackedBed& bed, const AnalysisWish& wish);

}  // namespace packbed
