#pragma once
// How deep a point is inside a body. Zero on the surface and outside, of unit slope at the surface, and C1:
// the force is the gradient of its 8th power, so nothing jumps.
//
//   spheres, cylinders, tubes, convex polyhedra, plain walls: in closed form (contact/depth_forms.hpp)
//   mesh: minus the signed distance, sampled on a regular grid and smoothed by quadratic B-splines
//         (contact/spline_block.hpp): a flat face is exact, a curved one has an error of third order in the
//         spacing, and an edge is rounded over a fraction of a spacing, four times finer ones near it
//         (contact/edge_blocks.hpp)
#include <cstdint>
#include <span>
#include <vector>

#include "contact/depth_forms.hpp"
#include "contact/edge_blocks.hpp"
#include "mesh/triangle_tree.hpp"
#include "shape/shape.hpp"

namespace packbed {

class DepthField {
 public:
  static DepthField of_sphere(double radius);
  static DepthField of_cylinder(double radius, double half_height);
  static DepthField of_tube(double radius, double inner_radius, double half_height);
  /// Of a convex polyhedron.
  static DepthField of_planes(const std::vector<Plane>& planes);
  /// The half space z < 0, and the outside of an upright tube of inner radius `radius` round the z axis.
  static DepthField of_floor();
  static DepthField of_bore(double radius);
  /// `spacing` of the grid [m]; depths beyond `deepest` are cut off there (0: none are).
  static DepthField of_mesh(const TriangleMesh& mesh, double spacing, double deepest = 0);
  /// Bytes that of_mesh would take, estimated from the area of the mesh; for a whole body without `deepest`,
  /// from its box.
  static double estimate_bytes(const TriangleMesh& mesh, double spacing, double deepest);

  void evaluate(const DepthBatch& batch) const;
  /// 0 outside, with the gradient.
  double depth(const Vec3& x, Vec3* gradient = nullptr) const;

  static constexpr std::size_t kChunk = 256;
  /// Writes the indices of the points that may be within radius[i] of the body (of x[i], in the field's
  /// frame; at most kChunk), leaving out only such as certainly are not. Returns how many. `apart`, if given:
  /// when there are none, a lower bound of what separates the spheres from the body [m], else 0.
  std::size_t near(const double* x, const double* y, const double* z, const double* radius, std::size_t count,
                   std::uint16_t* indices, double* apart = nullptr) const;

  double spacing() const { return spacing_; }
  std::size_t bytes() const;

 private:
  DepthField() = default;
  void make_coarse(const TriangleTree& tree, const Box3& box);
  /// Returns node 0 of each block.
  std::vector<Vec3> make_blocks(const TriangleTree& tree, double deepest);
  /// What the blocks say of a place near the surface, without what edges add [m].
  double splines(const Vec3& x) const;

  DepthForm form_;
  double spacing_ = 0;
  Vec3 origin_ = Vec3::Zero();            // of node (0, 0, 0)
  std::array<std::int32_t, 3> blocks_{};  // along x, y, z
  std::vector<std::int32_t> block_;       // (bz, by, bx) -> which block, or kOutside, kDeep
  std::vector<float> coefficient_;        // of minus the signed distance [m]
  double plateau_ = 0;                    // depth where kDeep [m]
  double steepest_ = 1;                   // bound of the slope of the splines [-]
  Vec3 box_centre_ = Vec3::Zero(), box_half_ = Vec3::Zero();  // of the body [m]
  EdgeBlocks edges_;
  // signed distance at the nodes of a coarse grid, rounded down: bounds for culling (1-Lipschitz)
  double coarse_spacing_ = 0;
  Vec3 coarse_origin_ = Vec3::Zero();
  std::array<std::int32_t, 3> coarse_size_{};
  std::vector<float> coarse_;
};

}  // namespace packbed
