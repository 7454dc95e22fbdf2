#pragma once
// Porosity of the core of a bed: what lies `margin` away from all side walls, the floor and the top. Three
// ways, as independent as they can be: exact (spheres), from the voxel grid (any shape, CT volumes), and by
// shots (Dziugys et al. 2022, section 3.2: evenly spread points in small test cells).
#include <optional>

#include "analysis/overlap.hpp"
#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"
#include "bed/scene.hpp"
#include "lattice/voxel_grid.hpp"

namespace packbed {

/// An upright cylinder or box about the z axis.
struct CoreRegion {
  double margin = 0;         // [m]
  double radius = 0;         // cylinder [m]; 0: a box
  Vec2 half = Vec2::Zero();  // box: half its widths [m]
  double from = 0, to = 0;   // heights [m]

  double volume() const;  // [m3]; 0: there is no core
  bool holds(const Vec3& x) const;
};

/// Inside a container with side walls, up to the top of the bed [m]. Nothing for a container without, and for
/// one with a core of its own.
std::optional<CoreRegion> core_region(const Container& container, double top, double margin);
/// margin: wish.core_margin times the largest diameter of the bed's pellets (sphere of equal volume) [m].
double core_margin(const PackedBed& bed, const AnalysisWish& wish);

/// Porosity of a bed of spheres, exact: closed forms and integrals (sphere_volume.hpp),
/// less what pairs share where they touch. NaN when some pellet is no sphere.
double exact_porosity(const PackedBed& bed, const CoreRegion& core, const std::vector<Overlap>& overlaps);

/// Share of void among the voxels whose centres lie in the core; NaN when there are none.
double voxel_porosity(const VoxelGrid& grid, const CoreRegion& core);

/// Cubes of edge `cell`, as many as fit in the core, in which n^3 points each are told to be in a pellet or
/// not. Fills the fields of shots.
void shoot_cells(const PackedBed& bed, const CoreRegion& core, double cell, int n, CorePorosity& out);

/// Region and definition, no number yet.
CorePorosity start_core(const CoreRegion& core);

}  // namespace packbed
