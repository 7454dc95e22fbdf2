#pragma once
// Contact of any two watertight bodies: the surface points of each against the depth field of the other, both
// ways, under the law of contact/touch.hpp with weights from contact/surface_points.hpp. Here as one Touch a
// pair; packers take it apart into patches (contact/patches.hpp).
//
//   delta^8 = (1 / 2 pi R) [ sum over points of a: w d_b^8 + sum over points of b: w d_a^8 ]
//
// The force is the exact gradient of this sum: weights are fixed and the fields are C1.
#include <limits>

#include "contact/depth_field.hpp"
#include "contact/surface_points.hpp"
#include "contact/touch.hpp"
#include "shape/container.hpp"
#include "shape/shape.hpp"

namespace packbed {

/// Resolution of a body.
struct FieldOptions {
  double spacing = 0;  // of surface points [m]; 0: diameter of the sphere of equal volume / kPointsAcross
  double grid = 0;     // cells across the same diameter, of a mesh's depth field; 0: kGridAcross
  double memory_bytes = 256e6;  // largest depth field
};
inline constexpr double kGridAcross = 56;
/// A wall has so many fewer cells across it than the body: 8 of 56.
inline constexpr double kWallShare = 1.0 / 7;

/// All that is needed of a shape, made once and shared by its pellets.
struct FieldBody {
  SurfacePoints points;
  DepthField field;
  double size = 0;  // reference length / 2 pi [m]
};
/// Throws InputError when the points or the field would be too many.
FieldBody make_field_body(const Shape& shape, const FieldOptions& options = {});

struct FieldPellet {
  const FieldBody* body = nullptr;
  Pose pose;
  double scale = 1;
};

/// `gap`, if given: the bodies, or either of them, may move by so much in all before they can touch [m]; 0
/// when they touch or are close.
Touch touch_field(const FieldPellet& a, const FieldPellet& b, double* gap = nullptr);

/// A wall that never moves: the half space z < 0, the outside of an upright tube round the z axis, or a mesh.
struct FieldWall {
  DepthField field;
  double trusted_depth = 0;  // of a mesh, whose field ends there: pellets so deep are lost [m]
};
FieldWall make_field_floor();
FieldWall make_field_bore(double radius);
/// `thickness`: smallest of the pellets' [m]. The grid is fine enough for them, or as fine as `limit_bytes`
/// lets it be; throws InputError, with the limit that would do, when that is too coarse for the wall.
FieldWall make_field_wall(const Container& container, double thickness, double limit_bytes = 64e6);
/// The pellet against the wall; `b` of the Touch is the container, with its centre at the origin.
Touch touch_container(const FieldPellet& a, const FieldWall& wall, double* gap = nullptr);

}  // namespace packbed
