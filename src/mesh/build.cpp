#include "mesh/build.hpp"

#include <cmath>

namespace packbed {
namespace {

using Triangle = std::array<std::int32_t, 3>;

}  // namespace

TriangleMesh revolved(const std::vector<std::pair<double, double>>& profile, int facets) {
  TriangleMesh mesh;
  std::vector<std::int32_t> first;  // vertex of the first meridian, one a point of the profile
  for (const auto& [r, z] : profile) {
    first.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
    for (int k = 0; k < (r == 0 ? 1 : facets); ++k) {
      const double angle = 2 * kPi * k / facets;
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
  }
  const auto vertex = [&](std::size_t point, int k) {
    return first[point] + (profile[point].first == 0 ? 0 : k % facets);
  };
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const std::size_t j = (i + 1) % profile.size();
    if (profile[i].first == 0 && profile[j].first == 0) continue;
    for (int k = 0; k < facets; ++k) {
      const std::int32_t a = vertex(i, k), b = vertex(i, k + 1), c = vertex(j, k), d = vertex(j, k + 1);
      if (a != b) mesh.triangles.push_back({a, b, d});
      if (c != d) mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

TriangleMesh box_mesh(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                               i & 4 ? high.z() : low.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh merged(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh out = a;
  const auto shift = static_cast<std::int32_t>(a.vertices.size());
  out.vertices.insert(out.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (Triangle t : b.triangles) {
    for (std::int32_t& v : t) v += shift;
    out.triangles.push_back(t);
  }
  return out;
}

}  // namespace packbed
