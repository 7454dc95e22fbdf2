#include "mesh/repair.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/topology.hpp"

namespace packbed {
namespace {

using Triangle = std::array<std::int32_t, 3>;

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

// Renumbers the vertices by `to` and drops those that no triangle uses.
void renumber(TriangleMesh& mesh, const std::vector<std::int32_t>& to) {
  std::vector<std::int32_t> number(mesh.vertices.size(), -1);
  std::vector<Vec3> vertices;
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& v : t) {
      const auto kept = static_cast<std::size_t>(to[static_cast<std::size_t>(v)]);
      if (number[kept] < 0) {
        number[kept] = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(mesh.vertices[kept]);
      }
      v = number[kept];
    }
  mesh.vertices = std::move(vertices);
}

// Joins vertices whose keys are equal; each group keeps its first vertex.
std::size_t join(TriangleMesh& mesh, const std::vector<Vec3>& keys) {
  std::vector<std::int32_t> order(keys.size()), to(keys.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::int32_t i) -> const Vec3& { return keys[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return before(key(a), key(b)) || (key(a) == key(b) && a < b);
  });
  std::size_t joined = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    const auto v = static_cast<std::size_t>(order[i]);
    to[v] = same ? to[static_cast<std::size_t>(order[i - 1])] : order[i];
    joined += same;
  }
  renumber(mesh, to);
  return joined;
}

// Height over the longest side, and which corner is opposite to it.
std::pair<double, int> flatness(const TriangleMesh& mesh, const Triangle& t) {
  double longest = 0;
  int opposite = 0;
  for (int i = 0; i < 3; ++i) {
    const double side = (corner(mesh, t, (i + 1) % 3) - corner(mesh, t, (i + 2) % 3)).norm();
    if (side > longest) {
      longest = side;
      opposite = i;
    }
  }
  return {longest > 0 ? 2 * triangle_area_vector(mesh, t).norm() / longest : 0, opposite};
}

double flat_height(const TriangleMesh& mesh) {
  return mesh.vertices.empty() ? 0 : kFlatTriangle * bounding_box(mesh).diagonal().norm();
}

void drop_repeated(TriangleMesh& mesh) {
  std::erase_if(mesh.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

// (a, b, c) is flat with b between a and c; its neighbour across c-a is (a, c, d). Makes (a, b, d), (b, c,
// d).
bool swap_long_side(TriangleMesh& mesh, std::size_t flat) {
  const int i = flatness(mesh, mesh.triangles[flat]).second;
  const Triangle t = mesh.triangles[flat];
  const auto at = [&](int k) { return t[static_cast<std::size_t>(k % 3)]; };
  const std::int32_t b = at(i), c = at(i + 1), a = at(i + 2);
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
    for (std::size_t k = 0; k < 3 && n != flat; ++k) {
      const Triangle& m = mesh.triangles[n];
      if (m[k] != a || m[(k + 1) % 3] != c) continue;
      const std::int32_t d = m[(k + 2) % 3];
      if (d == b) return false;
      mesh.triangles[flat] = {a, b, d};
      mesh.triangles[n] = {b, c, d};
      return true;
    }
  return false;
}

}  // namespace

std::size_t weld(TriangleMesh& mesh) {
  std::vector<Vec3> keys = mesh.vertices;
  for (Vec3& k : keys) k += Vec3::Zero();  // -0 becomes 0
  return join(mesh, keys);
}

std::size_t weld_within(TriangleMesh& mesh, double distance) {
  // One axis at a time: sorted coordinates closer than `distance` get one number
  std::vector<Vec3> keys = mesh.vertices;
  std::vector<std::size_t> order(keys.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::make_pair(mesh.vertices[a][axis], a) < std::make_pair(mesh.vertices[b][axis], b);
    });
    double group = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i > 0 && mesh.vertices[order[i]][axis] - mesh.vertices[order[i - 1]][axis] > distance) ++group;
      keys[order[i]][axis] = group;
    }
  }
  return join(mesh, keys);
}

std::vector<std::size_t> degenerate_triangles(const TriangleMesh& mesh) {
  const double limit = flat_height(mesh);
  std::vector<std::size_t> found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (flatness(mesh, mesh.triangles[t]).first <= limit) found.push_back(t);
  return found;
}

std::size_t drop_degenerate(TriangleMesh& mesh) {
  drop_repeated(mesh);
  std::vector<std::size_t> flat = degenerate_triangles(mesh);
  // Each swap settles one triangle and may flatten another once; a search a triangle is enough for the few
  // that real files have
  for (std::size_t round = 0; round < 4 && !flat.empty() && flat.size() <= 1000; ++round) {
    for (const std::size_t t : flat) swap_long_side(mesh, t);
    drop_repeated(mesh);
    flat = degenerate_triangles(mesh);
  }
  return flat.size();
}

}  // namespace packbed
