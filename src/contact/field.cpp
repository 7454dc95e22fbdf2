#include "contact/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/deep_points.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

constexpr std::size_t kMostClusters = 4096;  // of one body; more would be a spacing far too fine for its size

/// Adds the points that a sight sees. Returns the way to go before there are any, 0 when there are.
double add_side(const Sight& sight, const Vec3& origin, TouchSum<kPointExponent>& sum) {
  NearList near;
  DeepPoints deep;
  const double clear = std::min(list_near(sight, 0, near), std::numeric_limits<double>::max());
  find_deep(sight, 0, near, deep);
  add_deep(sight, deep, {}, 0, origin, sum);
  return deep.size > 0 ? 0.0 : std::min(clear_of_all(near), clear);
}

}  // namespace

FieldBody make_field_body(const Shape& shape, const FieldOptions& options) {
  const double diameter = shape.equivalent_diameter();
  const double spacing = options.spacing > 0 ? options.spacing : diameter / kPointsAcross;
  const double across = options.grid > 0 ? options.grid : kGridAcross;
  const double grid = std::min(diameter / across, shape.smallest_thickness / (kWallShare * across));
  const auto make_field = [&] {
    if (shape.kind == ShapeClass::sphere) return DepthField::of_sphere(shape.radius);
    if (shape.kind == ShapeClass::cylinder) return DepthField::of_cylinder(shape.radius, shape.half_height);
    if (shape.kind == ShapeClass::tube)
      return DepthField::of_tube(shape.radius, shape.inner_radius, shape.half_height);
    if (shape.kind == ShapeClass::convex) return DepthField::of_planes(shape.planes);
    const double bytes = DepthField::estimate_bytes(shape.surface, grid, 0);
    if (bytes > options.memory_bytes)
      throw InputError(
          "shape " + shape.name,
          fmt::format("a depth field of {:.0f} MB, of cells of {:.3g} mm for a thinnest wall of {:.3g} mm",
                      bytes / 1e6, grid * 1e3, shape.smallest_thickness * 1e3),
          fmt::format("{:.0f} MB", options.memory_bytes / 1e6), "raise field.memory_MB or lower field.grid");
    return DepthField::of_mesh(shape.surface, grid);
  };
  FieldBody body{sample_surface(shape, spacing), make_field(), size_radius(shape)};
  if (body.points.clusters() > kMostClusters)
    throw InputError(
        "shape " + shape.name,
        fmt::format("{} surface points at a spacing of {:.4g} mm", body.points.size(), spacing * 1e3),
        fmt::format("at most {}", kMostClusters * kCluster), "lower field.points");
  return body;
}

Touch touch_field(const FieldPellet& a, const FieldPellet& b, double* gap) {
  const Vec3 origin = 0.5 * (a.pose.position + b.pose.position);
  TouchSum<kPointExponent> sum(origin);
  const double of_a = add_side(sight(a, b.body->field, b.pose, b.scale, 1), origin, sum);
  const double of_b = add_side(sight(b, a.body->field, a.pose, a.scale, -1), origin, sum);
  if (gap) *gap = std::min(of_a, of_b);
  const double size = std::min(a.body->size * a.scale, b.body->size * b.scale);
  return sum.finish(2 * kPi * size, a.pose.position - origin, b.pose.position - origin);
}

FieldWall make_field_floor() {
  return {DepthField::of_floor(), 0};
}

FieldWall make_field_bore(double radius) {
  return {DepthField::of_bore(radius), 0};
}

FieldWall make_field_wall(const Container& container, double thickness, double limit_bytes) {
  // as deep as a pellet could ever be pressed in, and a few cells of it
  const double deepest = 0.25 * thickness;
  double spacing = thickness / 8;
  const double coarsest = thickness / 2.5;
  while (DepthField::estimate_bytes(container.surface, spacing, deepest) > limit_bytes && spacing < coarsest)
    spacing = std::min(coarsest, spacing * 1.1);
  const double bytes = DepthField::estimate_bytes(container.surface, spacing, deepest);
  if (bytes > limit_bytes)
    throw InputError(
        "container " + container.name,
        fmt::format("a wall whose depth field needs {:.0f} MB at the coarsest grid that still holds these "
                    "pellets ({:.3g} mm)",
                    bytes / 1e6, spacing * 1e3),
        fmt::format("{:.0f} MB", limit_bytes / 1e6),
        "raise the memory limit, or cut away what the bed never touches");
  return {DepthField::of_mesh(container.surface, spacing, deepest), 0.95 * deepest};
}

Touch touch_container(const FieldPellet& a, const FieldWall& wall, double* gap) {
  TouchSum<kPointExponent> sum(a.pose.position);
  const double clear = add_side(sight(a, wall.field, Pose(), 1, 1), a.pose.position, sum);
  if (gap) *gap = clear;
  return sum.finish(2 * kPi * a.body->size * a.scale, Vec3::Zero(), -a.pose.position);
}

}  // namespace packbed
