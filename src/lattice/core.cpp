#include "lattice/core.hpp"

#include <algorithm>
#include <cmath>

#include "lattice/rasterise.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

/// Rounding, and what the rasteriser's snapping moves a surface by: cells.
constexpr double kMargin = 1e-3;

/// Calls visit(x, y, z) for all cells that a triangle may touch; its corners are given in cells.
template <class Visit>
void for_each_touched(const Vec3& a, const Vec3& b, const Vec3& c, int size, const Visit& visit) {
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const Vec3 normal = (b - a).cross(c - a).stableNormalized();
  const double reach = 0.5 * normal.cwiseAbs().sum() + kMargin;
  int from[3], to[3];
  for (int d = 0; d < 3; ++d) {
    from[d] = std::max(0, static_cast<int>(std::floor(low[d] - kMargin)));
    to[d] = std::min(size - 1, static_cast<int>(std::floor(high[d] + kMargin)));
  }
  for (int z = from[2]; z <= to[2]; ++z)
    for (int y = from[1]; y <= to[1]; ++y)
      for (int x = from[0]; x <= to[0]; ++x)
        if (std::abs(normal.dot(Vec3(x + 0.5, y + 0.5, z + 0.5) - a)) <= reach) visit(x, y, z);
}

}  // namespace

Core::Core(const TriangleMesh& surface, double radius, double pitch) {
  GridFrame frame;
  frame.pitch = pitch;
  const int half = static_cast<int>(std::ceil(radius / pitch)) + 1;
  frame.size = {2 * half, 2 * half, 2 * half};
  frame.origin = Vec3::Constant(-half * pitch);
  half_ = half;
  cells_ = VoxelGrid(frame);
  Rasteriser rasteriser(frame);
  merge(rasteriser.mesh(surface, {}, 1.0, 0, frame.size[2]), cells_, 0);
  for (const auto& triangle : surface.triangles) {
    const auto in_cells = [&](int k) {
      return Vec3(corner(surface, triangle, k) / pitch + Vec3::Constant(half));
    };
    for_each_touched(in_cells(0), in_cells(1), in_cells(2), frame.size[0], [&](int x, int y, int z) {
      cells_.words[cells_.row(y, z) + static_cast<std::size_t>(x) / 64] &= ~(std::uint64_t{1} << (x % 64));
    });
  }
}

Vec3 Core::inwards(const Vec3& place, int reach) const {
  Vec3 sum = Vec3::Zero();
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        if (holds(place.x() + x, place.y() + y, place.z() + z)) sum += Vec3(x, y, z);
  return sum.stableNormalized();
}

}  // namespace packbed
