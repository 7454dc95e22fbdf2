#pragma once
// Volume of pellets between upright cylinders round the z axis, without voxels.
//
//   sphere             exact: geometry/sphere_volume.hpp
//   cylinder           lengths of vertical chords, in closed form, integrated over the angle within the
//   shadow
//                      that the pellet throws on the floor (its ends are found by bisection, the square-root
//                      behaviour there is taken out by a change of variable) and over the radius, by
//                      Gauss-Legendre rules
//   any closed mesh    exact: the integral of the height over each triangle's shadow within a disc, by
//   Green's
//                      theorem along its sides and arcs
#include <vector>

#include "bed/packed_bed.hpp"

namespace packbed {

/// For cylinders.
struct RadialRule {
  int angles = 24;  // nodes over the angle
  int radii = 2;    // nodes over a ring's width
  int scan = 24;    // points that look for the shadow's ends
};

/// Volume of all pellets between each radius and the next (radii ascend, from 0 or more) and between two
/// heights [m3] (radii - 1). What lies in two pellets counts twice. The density of a ring of
/// a full bed is converged to about 1e-4 with the default rule; docs/analysis.md has the table.
std::vector<double> ring_volumes(const PackedBed& bed, const std::vector<double>& radii, double z_low,
                                 double z_high, const RadialRule& rule = {});

}  // namespace packbed
