#include "mesh/triangle_tree.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/triangle.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

constexpr std::int32_t kLeaf = 4;
/// Places that are nearer to one another are one, fraction of the distance that is looked at.
constexpr double kSamePlace = 1e-6;

double corner_angle(const Vec3& at, const Vec3& to, const Vec3& other) {
  const Vec3 u = to - at, v = other - at;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

std::vector<std::array<Vec3, 7>> feature_normals(const TriangleMesh& mesh) {
  std::vector<std::array<Vec3, 7>> normals(mesh.triangles.size());
  std::vector<Vec3> at_vertex(mesh.vertices.size(), Vec3::Zero());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Vec3 n = triangle_area_vector(mesh, t).normalized();
    normals[i][0] = n;
    for (int k = 0; k < 3; ++k)
      at_vertex[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])] +=
          corner_angle(corner(mesh, t, k), corner(mesh, t, (k + 1) % 3), corner(mesh, t, (k + 2) % 3)) * n;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      normals[i][4 + k] = at_vertex[static_cast<std::size_t>(mesh.triangles[i][k])];
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i;
    Vec3 sum = Vec3::Zero();
    while (end < uses.size() && uses[end].low == uses[i].low && uses[end].high == uses[i].high)
      sum += normals[static_cast<std::size_t>(uses[end++].triangle)][0];
    for (; i < end; ++i) {
      const auto& t = mesh.triangles[static_cast<std::size_t>(uses[i].triangle)];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
        if (low == uses[i].low && high == uses[i].high)
          normals[static_cast<std::size_t>(uses[i].triangle)][1 + k] = sum;
      }
    }
  }
  return normals;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) : normal_(feature_normals(mesh)) {
  std::int32_t index = 0;
  for (const auto& t : mesh.triangles)
    triangles_.push_back({corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2), index++});
  nodes_.push_back({Box3(), 0, static_cast<std::int32_t>(triangles_.size())});
  split(0, triangles_);
}

void TriangleTree::split(std::int32_t at, std::vector<Triangle>& triangles) {
  const std::int32_t first = nodes_[static_cast<std::size_t>(at)].first;
  const std::int32_t count = nodes_[static_cast<std::size_t>(at)].count;
  Box3 box, centres;
  for (std::int32_t i = first; i < first + count; ++i) {
    const Triangle& t = triangles[static_cast<std::size_t>(i)];
    box.extend(t.a).extend(t.b).extend(t.c);
    centres.extend(Vec3(t.a + t.b + t.c));
  }
  nodes_[static_cast<std::size_t>(at)].box = box;
  if (count <= kLeaf) return;
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const auto key = [axis](const Triangle& t) { return t.a[axis] + t.b[axis] + t.c[axis]; };
  const auto middle = triangles.begin() + first + count / 2;
  std::nth_element(triangles.begin() + first, middle, triangles.begin() + first + count,
                   [&](const Triangle& t, const Triangle& u) {
                     return key(t) < key(u) || (key(t) == key(u) && t.index < u.index);
                   });
  const std::int32_t left = static_cast<std::int32_t>(nodes_.size());
  nodes_[static_cast<std::size_t>(at)].first = left;
  nodes_[static_cast<std::size_t>(at)].count = 0;
  nodes_.push_back({Box3(), first, count / 2});
  nodes_.push_back({Box3(), first + count / 2, count - count / 2});
  split(left, triangles);
  split(left + 1, triangles);
}

double TriangleTree::sign_at(const Vec3& from_surface, std::int32_t triangle, int feature) const {
  const Vec3& n = normal_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(feature)];
  return from_surface.dot(n) < 0 ? -1 : 1;
}

/// Calls visit(triangle) for the triangles of all leaves that come nearer than sqrt(bound2), near ones first;
/// visit may lower it.
template <class Visit>
void TriangleTree::visit_within(const Vec3& p, double& bound2, const Visit& visit) const {
  struct Item {
    std::int32_t node;
    double distance2;
  };
  std::array<Item, 128> stack;
  std::size_t size = 0;
  stack[size++] = {0, nodes_[0].box.squaredExteriorDistance(p)};
  while (size > 0) {
    const Item item = stack[--size];
    if (item.distance2 >= bound2) continue;
    const Node& node = nodes_[static_cast<std::size_t>(item.node)];
    for (std::int32_t i = node.first; i < node.first + node.count; ++i)
      visit(triangles_[static_cast<std::size_t>(i)]);
    if (node.count > 0) continue;
    Item near{node.first, nodes_[static_cast<std::size_t>(node.first)].box.squaredExteriorDistance(p)};
    Item far{node.first + 1, nodes_[static_cast<std::size_t>(node.first) + 1].box.squaredExteriorDistance(p)};
    if (far.distance2 < near.distance2) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& p, double bound) const {
  double best2 = bound * bound;
  TrianglePoint at;
  std::int32_t found = -1;
  visit_within(p, best2, [&](const Triangle& t) {
    const TrianglePoint candidate = closest_on_triangle(p, t.a, t.b, t.c);
    const double distance2 = (p - candidate.point).squaredNorm();
    if (distance2 < best2) best2 = distance2, at = candidate, found = t.index;
  });
  Nearest result;
  result.triangle = found;
  result.distance = bound;
  if (found < 0) return result;
  result.point = at.point;
  result.distance = std::sqrt(best2) * sign_at(p - at.point, found, at.feature);
  return result;
}

void TriangleTree::nearest_places(const Vec3& p, double bound, std::vector<Nearest>& places) const {
  struct Candidate {
    double distance2;
    TrianglePoint at;
    const Triangle* triangle;
  };
  thread_local std::vector<Candidate> candidates;
  candidates.clear();
  double bound2 = bound * bound;
  visit_within(p, bound2, [&](const Triangle& t) {
    const TrianglePoint at = closest_on_triangle(p, t.a, t.b, t.c);
    const double distance2 = (p - at.point).squaredNorm();
    if (distance2 < bound2) candidates.push_back({distance2, at, &t});
  });
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.triangle->index < b.triangle->index);
  });
  places.clear();
  const double same2 = kSamePlace * kSamePlace * bound2;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Candidate& c = candidates[k];
    if (sign_at(p - c.at.point, c.triangle->index, c.at.feature) < 0) {
      if (k > 0) continue;  // the far side of a thin wall
      places.push_back({-std::sqrt(c.distance2), c.at.point, c.triangle->index});
      return;
    }
    // an edge or a corner of a nearer triangle: the way down goes on in that one
    bool place = true;
    for (std::size_t j = 0; j < k && place && c.at.feature != 0; ++j) {
      const Triangle& t = *candidates[j].triangle;
      place = (closest_on_triangle(c.at.point, t.a, t.b, t.c).point - c.at.point).squaredNorm() > same2;
    }
    for (const Nearest& other : places) place = place && (other.point - c.at.point).squaredNorm() > same2;
    if (place) places.push_back({std::sqrt(c.distance2), c.at.point, c.triangle->index});
  }
}

}  // namespace packbed
