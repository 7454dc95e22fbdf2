#pragma once
// Depths in closed form, of bodies and of plain walls, and the records that all depth fields speak in.
//
//   sphere     (R^2 - r^2) / 2R
//   cylinder   a + b - sqrt(a^2 + b^2), a = (R^2 - rho^2) / 2R, b = (h^2 - z^2) / 2h
//   tube       the outer side, the inner side c = (rho^2 - r^2) / 2r and the caps, two at a time by
//              a + c - (a^4 + c^4)^(1/4)
//   planes     (sum over the faces of distance^-4)^(-1/4)
//   floor      -z
//   bore       (rho^2 - T^2) / 2T, outside of an upright tube of inner radius T
//
// Each is zero on the surface, of unit slope there, smooth inside, and never more than the distance to the
// nearest face.
#include <cstddef>
#include <vector>

#include "mesh/convex.hpp"

namespace packbed {

/// Points in the frame of a field and what it says of them; arrays of equal length, padded by the caller to a
/// multiple of 4 with any finite numbers.
struct DepthBatch {
  const double *x, *y, *z;  // [m]
  double* depth;            // [m]; outside: minus a lower bound of the way to where it is not 0, or 0
  double *gx, *gy, *gz;     // gradient of the depth [-]; not set outside
  std::size_t count = 0;
};

/// Spheres in the frame of a field.
struct SphereBatch {
  const double *x, *y, *z, *radius;  // [m]
  std::size_t count = 0;
};

enum class DepthKind { grid, sphere, cylinder, tube, planes, floor, bore };

/// What is known of a field in closed form (kind: not grid).
struct DepthForm {
  DepthKind kind = DepthKind::sphere;
  double radius = 0, inner_radius = 0, half_height = 0;  // [m]
  std::vector<double> nx, ny, nz, offset;                // of the planes: inside where n x < offset [-], [m]
};

void evaluate_form(const DepthForm& form, const DepthBatch& batch);
/// Lower bounds of the distances between the spheres and the body [m].
void bound_form(const DepthForm& form, const SphereBatch& spheres, double* bound);

}  // namespace packbed
