#pragma once
// How much of a sphere lies in a box, in an upright cylinder or in another sphere. The cuts of level planes
// are closed forms; they are integrated over the height between the heights where the form changes, by a rule
// that knows the square roots at these ends: within 1e-7 of r^3 where two such heights all but meet, mostly
// within 1e-11.
#include "math/types.hpp"

namespace packbed {

/// Area of the disc of radius r about the origin that lies in a rectangle [m2].
double disc_in_rectangle(double r, const Vec2& low, const Vec2& high);
/// Area shared by discs of radii r and s, centres `distance` apart [m2].
double disc_in_disc(double r, double s, double distance);

/// Of the sphere about `centre` in the box [m3].
double sphere_in_box(const Vec3& centre, double radius, const Box3& box);
/// Of the sphere in the upright cylinder of radius `around` about the z axis, between two heights [m3].
double sphere_in_cylinder(const Vec3& centre, double radius, double around, double z_low, double z_high);
/// Shared by two spheres, centres `distance` apart [m3] (a lens of two caps).
double sphere_in_sphere(double r, double s, double distance);

}  // namespace packbed
