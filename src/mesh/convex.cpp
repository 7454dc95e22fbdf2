#include "mesh/convex.hpp"

#include <algorithm>
#include <numeric>

#include "mesh/topology.hpp"

namespace packbed {
namespace {

double slack_of(const TriangleMesh& mesh) {
  return kPlaneTolerance * bounding_box(mesh).diagonal().norm();
}

Plane plane_of(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t) {
  const Vec3 normal = triangle_area_vector(mesh, t).normalized();
  return {normal, normal.dot(triangle_centre(mesh, t))};
}

double above(const Plane& plane, const Vec3& p) {
  return plane.normal.dot(p) - plane.offset;
}

// Cheap refusal of nearly every mesh that is not convex: at some edge the neighbour rises above the facet.
bool bends_inward(const TriangleMesh& mesh, double slack) {
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for (std::size_t i = 0; i + 1 < uses.size(); i += 2) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(uses[i].triangle)];
    const auto& neighbour = mesh.triangles[static_cast<std::size_t>(uses[i + 1].triangle)];
    if (triangle_area_vector(mesh, t).norm() <= slack * slack) continue;
    const Plane plane = plane_of(mesh, t);
    for (int k = 0; k < 3; ++k)
      if (above(plane, corner(mesh, neighbour, k)) > slack) return true;
  }
  return false;
}

std::vector<std::size_t> largest_first(const TriangleMesh& mesh) {
  std::vector<double> area;
  for (const auto& t : mesh.triangles) area.push_back(triangle_area_vector(mesh, t).norm());
  std::vector<std::size_t> order(area.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return area[a] > area[b]; });
  return order;
}

}  // namespace

std::vector<Plane> convex_planes(const TriangleMesh& mesh) {
  const double slack = slack_of(mesh);
  if (mesh.triangles.empty() || bends_inward(mesh, slack)) return {};
  std::vector<Plane> planes;
  for (const std::size_t i : largest_first(mesh)) {
    const auto& t = mesh.triangles[i];
    const Vec3 square = triangle_area_vector(mesh, t);
    const auto holds = [&](const Plane& plane) {
      for (int k = 0; k < 3; ++k)
        if (std::abs(above(plane, corner(mesh, t, k))) > slack) return false;
      return plane.normal.dot(square) > 0;
    };
    if (square.norm() > slack * slack && std::none_of(planes.begin(), planes.end(), holds))
      planes.push_back(plane_of(mesh, t));
  }
  for (const Plane& plane : planes)
    for (const Vec3& v : mesh.vertices)
      if (above(plane, v) > slack) return {};
  return planes;
}

std::vector<Vec3> polyhedron_corners(const TriangleMesh& mesh, const std::vector<Plane>& planes) {
  const double slack = 2 * slack_of(mesh);
  std::vector<Vec3> corners;
  for (const Vec3& v : mesh.vertices)
    if (std::count_if(planes.begin(), planes.end(),
                      [&](const Plane& plane) { return std::abs(above(plane, v)) <= slack; }) >= 3)
      corners.push_back(v);
  return corners;
}

}  // namespace packbed
