#pragma once
// The inside of a body without what is near its surface, as cells of a fine grid in the body's own frame:
// tells of most points of the inside, by one look, that they are inside.
#include "lattice/voxel_grid.hpp"
#include "mesh/mesh.hpp"

namespace packbed {

class Core {
 public:
  /// Cells of this pitch that lie wholly inside a closed surface, all of it within `radius` of the origin
  /// [m].
  Core(const TriangleMesh& surface, double radius, double pitch);

  /// Whether the cell at a place, counted in cells from the origin, is one of them.
  bool holds(double x, double y, double z) const {
    const int size = cells_.frame.size[0];
    const int at[] = {static_cast<int>(x + half_), static_cast<int>(y + half_), static_cast<int>(z + half_)};
    for (const int a : at)
      if (a < 0 || a >= size) return false;
    return cells_.solid(at[0], at[1], at[2]);
  }
  /// From a place near the surface (in cells) towards the cells within `reach` of it, length 1; zero where
  /// there are none, or as many on either side.
  Vec3 inwards(const Vec3& place, int reach) const;

 private:
  double half_ = 0;  // cells from the corner to the origin
  VoxelGrid cells_;
};

}  // namespace packbed
