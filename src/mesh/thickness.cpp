#include <algorithm>
#include <cmath>

#include "mesh/check.hpp"
#include "mesh/inside.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

constexpr double kSamples = 4000;               // points over the surface, beside one a triangle
constexpr double kFacing = 0.7071067811865476;  // cosine of 45 degrees
constexpr std::size_t kDirections = 2000;       // of facets, tried for the smallest width
constexpr std::size_t kSharpEdges = 64;         // bodies with more are as good as smooth

using Triangle = std::array<std::int32_t, 3>;

// The shortest way through the material from one point of a triangle, if there is a wall behind it.
void probe(const TriangleMesh& mesh, const MeshQuery& query, std::size_t triangle, const Vec3& normal,
           const Vec3& point, double nothing, Thickness& best) {
  for (const RayHit& hit : query.ray(point, -normal)) {
    if (hit.triangle == triangle || hit.distance <= nothing) continue;
    const Vec3 back = triangle_area_vector(mesh, mesh.triangles[hit.triangle]).normalized();
    if (back.dot(normal) < -kFacing && (best.value == 0 || hit.distance < best.value))
      best = {hit.distance, point};
    return;
  }
}

// k-th point of an even spread over a triangle (Roberts' R2 sequence, folded).
Vec3 spread(const TriangleMesh& mesh, const Triangle& t, std::size_t k) {
  const double n = static_cast<double>(k);
  double u = std::fmod(0.5 + 0.7548776662466927 * n, 1.0), v = std::fmod(0.5 + 0.5698402909980532 * n, 1.0);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return corner(mesh, t, 0) + u * (corner(mesh, t, 1) - corner(mesh, t, 0)) +
         v * (corner(mesh, t, 2) - corner(mesh, t, 0));
}

std::vector<Vec3> sharp_edges(const TriangleMesh& mesh) {
  std::vector<Vec3> found;
  for (const MeshEdge& e : mesh_edges(mesh)) {
    if (std::cos(e.angle) > 0.98) continue;
    found.push_back(edge_vector(mesh, e).normalized());
    if (found.size() > kSharpEdges) return {};
  }
  return found;
}

// Of a polyhedron the width is smallest square to a facet or square to two edges (Houle and Toussaint, IEEE
// Trans. Pattern Anal. 10 (1988) 761).
std::vector<Vec3> width_directions(const TriangleMesh& mesh) {
  std::vector<Vec3> out;
  const std::size_t stride = mesh.triangles.size() / kDirections + 1;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += stride)
    out.push_back(triangle_area_vector(mesh, mesh.triangles[t]).normalized());
  const std::vector<Vec3> edges = sharp_edges(mesh);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 square = edges[i].cross(edges[j]);
      if (square.norm() > 1e-6) out.push_back(square.normalized());
    }
  return out;
}

Thickness smallest_width(const TriangleMesh& mesh) {
  Thickness best;
  for (const Vec3& direction : width_directions(mesh)) {
    double low = INFINITY, high = -INFINITY;
    std::size_t at = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const double x = mesh.vertices[v].dot(direction);
      low = std::min(low, x);
      if (x > high) {
        high = x;
        at = v;
      }
    }
    if (best.value == 0 || high - low < best.value) best = {high - low, mesh.vertices[at]};
  }
  return best;
}

}  // namespace

Thickness thinnest_wall(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  const MeshQuery query(mesh);
  const double nothing = 1e-9 * bounding_box(mesh).diagonal().norm();
  const double area = mass_properties(mesh).area;
  Thickness wall;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const Vec3 square = triangle_area_vector(mesh, triangle);
    if (square.norm() == 0) continue;
    probe(mesh, query, t, square.normalized(), triangle_centre(mesh, triangle), nothing, wall);
    const auto more = static_cast<std::size_t>(kSamples * square.norm() / area);
    for (std::size_t k = 1; k <= more; ++k)
      probe(mesh, query, t, square.normalized(), spread(mesh, triangle, k), nothing, wall);
  }
  const Thickness width = smallest_width(mesh);
  return wall.value == 0 || width.value < wall.value ? width : wall;
}

}  // namespace packbed
