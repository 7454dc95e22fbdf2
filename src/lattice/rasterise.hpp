#pragma once
// One body into bits by the centroid rule: a voxel is solid when its centre lies inside the body.
//
//   closed mesh   vertices are snapped to a lattice of 2^-12 of a voxel, every triangle is scan-converted
//   over the
//                 (y, z) rows that it covers in exact integers, half-open, and each crossing toggles one bit;
//                 a prefix exclusive-or along x turns crossings into solid. Each row is crossed an even
//                 number of times, so a closed mesh closes in every pose (after Schwarz & Seidel, ACM TOG 29,
//                 2010).
//   sphere, cylinder, tube   the interval of x that a row has inside the body, in closed form.
#include <cstdint>
#include <vector>

#include "lattice/cylinder_rows.hpp"
#include "lattice/voxel_grid.hpp"
#include "shape/shape.hpp"

namespace packbed {

/// Parts of a voxel that mesh vertices are snapped to.
inline constexpr std::int64_t kSnap = 4096;

/// Solid bits of one body in a box of a grid. Along x the box is made of whole words of the grid's rows and
/// may reach beyond the grid; along y and z it lies inside the grid.
struct BitBlock {
  int word = 0, words = 0;          // first word of a grid row (may be negative) and number of words
  int y = 0, ny = 0;                // first row and number of rows
  int z = 0, nz = 0;                // first slice and number of slices
  std::int64_t count = -1;          // bits set, where the rasteriser knows; else -1
  std::vector<std::uint64_t> bits;  // (nz, ny, words); bit i of word w is voxel x = 64 (word + w) + i

  std::uint64_t* row(int j, int k) {
    return bits.data() +
           (static_cast<std::size_t>(k) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(words);
  }
  const std::uint64_t* row(int j, int k) const { return const_cast<BitBlock*>(this)->row(j, k); }
};

/// Turns bodies into bits of one grid, one after another; keeps its memory between calls.
class Rasteriser {
 public:
  explicit Rasteriser(const GridFrame& frame) : frame_(frame) {}

  /// Bits of a body in slices [z_begin, z_end) of the grid. Valid until the next call.
  const BitBlock& body(const Shape& shape, const Pose& pose, double scale, int z_begin, int z_end);
  /// Bits of a closed mesh, x -> pose(scale x).
  const BitBlock& mesh(const TriangleMesh& surface, const Pose& pose, double scale, int z_begin, int z_end);

  std::int64_t rows() const { return rows_; }  ///< rows of all mesh boxes so far
  std::int64_t open_rows() const {
    return open_rows_;
  }  ///< of these, those that did not close: 0 unless a mesh is open

 private:
  struct Corner {
    std::int64_t x, y, z;
  };
  bool set_box(const Vec3& low, const Vec3& high, int z_begin, int z_end);
  void sphere(const Vec3& centre, double radius);
  void cylinder(const Vec3& centre, const Vec3& axis, double radius, double bore, double half_height);
  struct Corners {
    const Corner &a, &b, &c;
  };
  Corners corners_of(const std::array<std::int32_t, 3>& t) const {
    const auto at = [&](std::size_t i) -> const Corner& { return corners_[static_cast<std::size_t>(t[i])]; };
    return {at(0), at(1), at(2)};
  }
  void find_crossing(const TriangleMesh& surface);
  template <class Int>
  void triangle(const Corner& a, const Corner& b, const Corner& c);
  void close_rows();

  GridFrame frame_;
  BitBlock block_;
  RowIntervals intervals_;
  std::vector<Vec3> posed_;              // vertices in voxels, voxel centres at whole numbers
  std::vector<Corner> corners_;          // the same, snapped, counted from corner_base_
  std::vector<std::uint32_t> crossing_;  // triangles that cross rows
  std::array<std::int64_t, 3> corner_base_{0, 0, 0};
  std::int64_t rows_ = 0, open_rows_ = 0;
};

/// ORs a block into a grid. Where the grid has labels, voxels that had none get `label`. Returns the number
/// of voxels that were solid already.
std::int64_t merge(const BitBlock& block, VoxelGrid& grid, std::int32_t label);

}  // namespace packbed
