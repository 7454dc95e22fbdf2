#include "shape/container.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/inside.hpp"
#include "mesh/topology.hpp"
#include "shape/recognise.hpp"

namespace packbed {
namespace {

void move(TriangleMesh& mesh, const Vec3& by) {
  for (Vec3& p : mesh.vertices) p += by;
}

// The top of the lowest piece of material that a vertical line meets. Nothing when the line meets none.
std::optional<double> top_of_lowest(const MeshQuery& query, const TriangleMesh& mesh, double x, double y,
                                    double below) {
  for (const RayHit& hit : query.ray(Vec3(x, y, below), Vec3::UnitZ()))
    if (triangle_area_vector(mesh, mesh.triangles[hit.triangle]).z() > 0) return below + hit.distance;
  return {};
}

// Height of the inner face of the floor: under the middle of the mesh; where a core stands there, the lowest
// point of the hollow that a walk outwards from it meets first.
std::optional<double> find_floor(const TriangleMesh& mesh, const Vec3& middle) {
  constexpr int kSteps = 400;  // from the middle to the side
  const Box3 box = bounding_box(mesh);
  const double below = box.min().z() - box.sizes().z(), step = box.sizes().x() / 2 / kSteps;
  const MeshQuery query(mesh);
  const auto at = [&](int i) { return top_of_lowest(query, mesh, middle.x() + i * step, middle.y(), below); };
  const std::optional<double> axis = at(0);
  if (!axis || *axis - box.min().z() < 0.5 * box.sizes().z()) return axis;
  const double in_hollow = *axis - 0.05 * box.sizes().z();
  std::optional<double> floor;
  for (int i = 1; i < kSteps; ++i) {
    const std::optional<double> here = at(i);
    const bool hollow = here && *here < in_hollow;
    if (floor && !hollow) break;
    if (hollow) floor = std::min(*here, floor.value_or(*here));
  }
  return floor ? floor : axis;
}

double distance_from_axis(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp(-a.dot(along) / square, 0.0, 1.0) : 0;
  return (a + t * along).norm();
}

// What a horizontal cut at height z leaves free round the z axis: up to the nearest wall that faces the axis,
// from the core, whose sides face away from it. Nothing is free where the axis is in a wall without a hollow.
void measure_cut(Container& c, double z) {
  struct Side {
    double near, far;
  };
  double radius = INFINITY;
  std::vector<Side> facing_away;
  for (const auto& t : c.surface.triangles) {
    std::vector<Eigen::Vector2d> cut;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = corner(c.surface, t, k), b = corner(c.surface, t, (k + 1) % 3);
      if ((a.z() <= z) == (b.z() <= z)) continue;
      const double s = (z - a.z()) / (b.z() - a.z());
      cut.emplace_back((a + s * (b - a)).head<2>());
    }
    if (cut.size() != 2) continue;
    const double near = distance_from_axis(cut[0], cut[1]);
    if (triangle_area_vector(c.surface, t).head<2>().dot(cut[0] + cut[1]) < 0)
      radius = std::min(radius, near);
    else
      facing_away.push_back({near, std::max(cut[0].norm(), cut[1].norm())});
  }
  const bool core = winding_number(c.surface, Vec3(0, 0, z)) > 0.5;
  for (const Side& side : facing_away) {
    if (core && side.near < radius) c.core_radius = std::max(c.core_radius, side.far);
    if (!core) radius = std::min(radius, side.near);
  }
  c.radius = std::isfinite(radius) ? radius : 0;
  if (c.radius == 0) c.core_radius = 0;
}

void place_tube(Container& c, const TubeFit& tube) {
  c.kind = ContainerKind::tube;
  c.radius = tube.radius;
  c.height = tube.height;
  move(c.surface, -tube.floor);
}

void place_box(Container& c, const BoxFit& box) {
  c.kind = ContainerKind::box;
  c.width = box.width;
  c.depth = box.depth;
  c.radius = std::min(box.width, box.depth) / 2;
  c.height = box.height;
  move(c.surface, -box.floor);
}

void place_mesh(Container& c) {
  c.kind = ContainerKind::mesh;
  const Vec3 middle = bounding_box(c.surface).center();
  const std::optional<double> floor = find_floor(c.surface, middle);
  move(c.surface, Vec3(-middle.x(), -middle.y(), floor ? -*floor : 0));
  c.height = std::max(0.0, bounding_box(c.surface).max().z());
  measure_cut(c, c.height / 2);
}

}  // namespace

std::string_view to_string(ContainerKind kind) {
  switch (kind) {
    case ContainerKind::none:
      return "none";
    case ContainerKind::plane:
      return "plane";
    case ContainerKind::tube:
      return "tube";
    case ContainerKind::box:
      return "box";
    case ContainerKind::mesh:
      return "mesh";
  }
  return "";
}

bool has_sides(ContainerKind kind) {
  return kind != ContainerKind::none && kind != ContainerKind::plane;
}

Container make_tube(const std::string& name, double inner_diameter, double height) {
  Container c;
  c.kind = ContainerKind::tube;
  c.name = name;
  c.source = fmt::format("tube of inner diameter {:.6g} mm and height {:.6g} mm", 1e3 * inner_diameter,
                         1e3 * height);
  c.radius = inner_diameter / 2;
  c.height = height;
  return c;
}

Container make_box(const std::string& name, double width, double depth, double height) {
  Container c;
  c.kind = ContainerKind::box;
  c.name = name;
  c.source = fmt::format("box of {:.6g} x {:.6g} mm inside and height {:.6g} mm", 1e3 * width, 1e3 * depth,
                         1e3 * height);
  c.width = width;
  c.depth = depth;
  c.radius = std::min(width, depth) / 2;
  c.height = height;
  return c;
}

Container make_container(const std::string& name, const std::string& source, const TriangleMesh& mesh,
                         bool recognise) {
  Container c;
  c.name = name;
  c.source = source;
  c.surface = mesh;
  c.mesh_volume = mass_properties(mesh).volume;
  const std::optional<TubeFit> tube = recognise ? recognise_tube(mesh) : std::nullopt;
  const std::optional<BoxFit> box = recognise && !tube ? recognise_box(mesh) : std::nullopt;
  if (tube)
    place_tube(c, *tube);
  else if (box)
    place_box(c, *box);
  else
    place_mesh(c);
  return c;
}

}  // namespace packbed
