#pragma once
// How deep pellets dip into each other and into the container, measured from shapes and poses alone.
#include <vector>

#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"

namespace packbed {

/// One touching pair. b is kContainer for the wall and for the floor, each a pair of its own.
struct Overlap {
  std::uint32_t a = 0, b = 0;  // places in PackedBed::pellets, a < b
  double depth = 0;            // [m]
  double fraction = 0;         // of the smaller of the two smallest thicknesses
  double volume = 0;  // shared by two pellets [m3], estimated; 0 with the container and for bodies that are
                      // not convex
  Vec3 point = Vec3::Zero();  // where [m]
};

/// All pairs deeper than 1e-9 of the thickness, in the order of a, then b. Convex pellets: the penetration
/// depth (see penetration.hpp). Tube and plane: how far the pellet reaches beyond, exact. Pellets or
/// container of meshes that are not convex: the deepest of the corners, middles of sides and middles of
/// triangles of each body inside the other, which is a lower bound.
std::vector<Overlap> find_overlaps(const PackedBed& bed);

OverlapAudit audit_overlaps(const PackedBed& bed, const std::vector<Overlap>& overlaps);

/// Largest distance of a pellet's points from the z axis [m]: exact, for a tube's wall.
double reach_from_axis(const Shape& shape, const Pellet& pellet);

}  // namespace packbed
