#pragma once
// How pellets lie: the angle between their axis and the vertical, and the equal-area projection of the axes.
#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"

namespace packbed {

/// Axis of a shape in its own frame: z for a body of revolution, else the principal axis whose moment of
/// inertia stands apart from the other two. None for a sphere and for bodies whose three moments agree within
/// 1 %.
std::optional<Vec3> shape_axis(const Shape& shape);

/// Angles in classes of 10 degrees; the reference is cos(from) - cos(to), the share of uniformly random axes.
/// Projection: an axis pointing down at colatitude t lands sqrt(2) sin(t / 2) from the centre of the unit
/// disc (Lambert, 1772), so that equal solid angles have equal areas: a vertical axis is the centre,
/// horizontal ones are on the rim.
Orientation orientation(const PackedBed& bed);

}  // namespace packbed
