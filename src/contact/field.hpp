#pragma once
// Contact of any two watertight bodies: the surface points of each against the depth field of the other, both
// ways, under the law of contact/touch.hpp with weights from contact/surface_points.hpp. Convex or not, one
// Touch a pair: a pair that touches in two places has both in its sums.
//
//   delta^8 = (1 / 2 pi R) [ sum over points of a: w d_b^8 + sum over points of b: w d_a^8 ]
//
// The force is the exact gradient of this sum: weights are fixed and the fields are C1.
#include "contact/depth_field.hpp"
#include "contact/surface_points.hpp"
#include "contact/touch.hpp"
#include "shape/container.hpp"
#include "shape/shape.hpp"

namespace packbed {

/// Resolution of a body; 0: found from the shape.
struct FieldOptions {
  double spacing = 0;  // of surface points [m]; else diameter of the sphere of equal volume / kPointsAcross
  double grid = 0;     // of a mesh's depth field [m]; else the same diameter / kGridAcross, or 1/8 of its
                       // smallest thickness if that is less
};
inline constexpr double kPointsAcross = 14;
inline constexpr double kGridAcross = 56;

/// All that is needed of a shape, made once and shared by its pellets.
struct FieldBody {
  SurfacePoints points;
  DepthField field;
  double size = 0;           // reference length / 2 pi [m]
  double reach = 0;          // bounding radius [m]
  double trusted_depth = 0;  // beyond it the field may push out on the wrong side: 0.4 of the smallest
                             // thickness [m]; the caller compares Touch::depth
  double cover = 0;          // no point of the surface is farther than this from one of `points` [m]
};
FieldBody make_field_body(const Shape& shape, const FieldOptions& options = {});

struct FieldPellet {
  const FieldBody* body = nullptr;
  Pose pose;
  double scale = 1;
};

/// `gap`, if given: the bodies, or either of them, may move by so much in all before they can touch [m]; 0
/// when they touch or are close.
Touch touch_field(const FieldPellet& a, const FieldPellet& b, double* gap = nullptr);

/// With the half space z < 0, and with the outside of an upright tube of inner radius `tube` round the z
/// axis.
Touch touch_floor(const FieldPellet& a);
Touch touch_tube(const FieldPellet& a, double tube);

/// The wall of a mesh container, static.
struct FieldWall {
  DepthField field;
  double trusted_depth = 0;  // the field ends there: pellets so deep are lost [m]
};
/// `thickness`: smallest of the pellets' [m]. The grid is fine enough for them, or as fine as `limit_bytes`
/// lets it be; throws InputError, with the limit that would do, when that is too coarse for the wall.
FieldWall make_field_wall(const Container& container, double thickness, double limit_bytes = 64e6);
/// The pellet against the wall; `b` of the Touch is the container, with its centre at the origin.
Touch touch_container(const FieldPellet& a, const FieldWall& wall, double* gap = nullptr);

}  // namespace packbed
