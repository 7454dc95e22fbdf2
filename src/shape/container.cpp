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

// Height of the inner face of the floor under the middle of the mesh: the top of the lowest piece of material
// that a vertical line through the middle meets. Nothing when the line meets none.
std::optional<double> floor_under(const TriangleMesh& mesh, const Vec3& middle) {
  const Box3 box = bounding_box(mesh);
  const double below = box.min().z() - box.sizes().z();
  for (const RayHit& hit : MeshQuery(mesh).ray(Vec3(middle.x(), middle.y(), below), Vec3::UnitZ()))
    if (triangle_area_vector(mesh, mesh.triangles[hit.triangle]).z() > 0) return below + hit.distance;
  return {};
}

double distance_from_axis(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp(-a.dot(along) / square, 0.0, 1.0) : 0;
  return (a + t * along).norm();
}

// Radius of the largest circle round the z axis that a horizontal cut at height z leaves free; 0 when the
// axis is inside the material there.
double free_radius(const TriangleMesh& mesh, double z) {
  double radius = INFINITY;
  for (const auto& t : mesh.triangles) {
    std::vector<Eigen::Vector2d> cut;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = corner(mesh, t, k), b = corner(mesh, t, (k + 1) % 3);
      if ((a.z() <= z) == (b.z() <= z)) continue;
      const double s = (z - a.z()) / (b.z() - a.z());
      cut.emplace_back((a + s * (b - a)).head<2>());
    }
    if (cut.size() == 2) radius = std::min(radius, distance_from_axis(cut[0], cut[1]));
  }
  if (!std::isfinite(radius) || winding_number(mesh, Vec3(0, 0, z)) > 0.5) return 0;
  return radius;
}

void place_tube(Container& c, const TubeFit& tube) {
  c.kind = ContainerKind::tube;
  c.radius = tube.radius;
  c.height = tube.height;
  move(c.surface, -tube.floor);
}

void place_mesh(Container& c) {
  c.kind = ContainerKind::mesh;
  const Vec3 middle = bounding_box(c.surface).center();
  const std::optional<double> floor = floor_under(c.surface, middle);
  move(c.surface, Vec3(-middle.x(), -middle.y(), floor ? -*floor : 0));
  c.height = std::max(0.0, bounding_box(c.surface).max().z());
  c.radius = free_radius(c.surface, c.height / 2);
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
    case ContainerKind::mesh:
      return "mesh";
  }
  return "";
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

Container make_container(const std::string& name, const std::string& source, const TriangleMesh& mesh,
                         bool recognise) {
  Container c;
  c.name = name;
  c.source = source;
  c.surface = mesh;
  c.mesh_volume = mass_properties(mesh).volume;
  const std::optional<TubeFit> tube = recognise ? recognise_tube(mesh) : std::nullopt;
  if (tube)
    place_tube(c, *tube);
  else
    place_mesh(c);
  return c;
}

}  // namespace packbed
