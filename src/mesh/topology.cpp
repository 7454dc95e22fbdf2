#include "mesh/topology.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace packbed {
namespace {

using Triangle = std::array<std::int32_t, 3>;

// Calls visit(first, last) for the uses of each edge.
template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, const Visit& visit) {
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t j = i + 1;
    while (j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high) ++j;
    visit(i, j);
    i = j;
  }
}

struct Link {
  std::int32_t triangle;
  bool agrees;  // the two triangles run along their edge in opposite ways, as they should
};

// Neighbours of each triangle through edges, as one list with starts; sets `manifold`.
struct Neighbours {
  std::vector<std::size_t> start;
  std::vector<Link> links;
  bool manifold = true;
};

Neighbours neighbours(const TriangleMesh& mesh) {
  Neighbours out;
  std::vector<std::tuple<std::int32_t, std::int32_t, bool>> pairs;
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for_each_edge(uses, [&](std::size_t i, std::size_t j) {
    if (j - i > 2) out.manifold = false;
    for (std::size_t k = i + 1; k < j; ++k) {
      const bool agrees = uses[k].forward != uses[i].forward;
      pairs.emplace_back(uses[i].triangle, uses[k].triangle, agrees);
      pairs.emplace_back(uses[k].triangle, uses[i].triangle, agrees);
    }
  });
  std::sort(pairs.begin(), pairs.end());
  out.start.assign(mesh.triangles.size() + 1, 0);
  for (const auto& [from, to, agrees] : pairs) {
    ++out.start[static_cast<std::size_t>(from) + 1];
    out.links.push_back({to, agrees});
  }
  for (std::size_t i = 1; i < out.start.size(); ++i) out.start[i] += out.start[i - 1];
  return out;
}

// Visits every triangle, piece by piece: begin(triangle) starts a piece, step(from, link) crosses an edge.
template <class Begin, class Step>
void flood(const TriangleMesh& mesh, const Neighbours& near, const Begin& begin, const Step& step) {
  std::vector<int> seen(mesh.triangles.size(), 0);
  std::vector<std::int32_t> open;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = 1;
    begin(first);
    open.push_back(static_cast<std::int32_t>(first));
    while (!open.empty()) {
      const auto from = static_cast<std::size_t>(open.back());
      open.pop_back();
      for (std::size_t k = near.start[from]; k < near.start[from + 1]; ++k) {
        const auto to = static_cast<std::size_t>(near.links[k].triangle);
        step(from, near.links[k], seen[to] != 0);
        if (seen[to]) continue;
        seen[to] = 1;
        open.push_back(near.links[k].triangle);
      }
    }
  }
}

// Appends a triangle with those of its vertices that are new to `out`.
void append(TriangleMesh& out, const std::vector<Vec3>& vertices, Triangle t,
            std::map<std::int32_t, std::int32_t>& number) {
  for (std::int32_t& v : t) {
    const auto [at, fresh] = number.emplace(v, static_cast<std::int32_t>(out.vertices.size()));
    if (fresh) out.vertices.push_back(vertices[static_cast<std::size_t>(v)]);
    v = at->second;
  }
  out.triangles.push_back(t);
}

}  // namespace

std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), a < b});
    }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& x, const EdgeUse& y) {
    return std::tie(x.low, x.high, x.triangle) < std::tie(y.low, y.high, y.triangle);
  });
  return uses;
}

std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh) {
  const auto normal = [&](std::int32_t t) {
    return triangle_area_vector(mesh, mesh.triangles[static_cast<std::size_t>(t)]).normalized();
  };
  std::vector<MeshEdge> edges;
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
    const EdgeUse &one = uses[i], &two = uses[i + 1];
    if (one.low != two.low || one.high != two.high) continue;
    const std::int32_t left = (one.forward ? one : two).triangle, right = (one.forward ? two : one).triangle;
    const Vec3 n = normal(left), m = normal(right);
    const double angle = std::atan2(n.cross(m).norm(), n.dot(m));
    edges.push_back(
        {one.low, one.high, left, right, n.cross(m).dot(edge_vector(mesh, one)) > 0 ? angle : -angle});
    ++i;
  }
  return edges;
}

Pieces pieces(const TriangleMesh& mesh) {
  Pieces out;
  out.of_triangle.assign(mesh.triangles.size(), -1);
  flood(
      mesh, neighbours(mesh), [&](std::size_t first) { out.of_triangle[first] = out.count++; },
      [&](std::size_t from, const Link& link, bool) {
        out.of_triangle[static_cast<std::size_t>(link.triangle)] = out.of_triangle[from];
      });
  return out;
}

std::vector<TriangleMesh> split(const TriangleMesh& mesh, const Pieces& pieces) {
  std::vector<TriangleMesh> out(static_cast<std::size_t>(pieces.count));
  std::vector<std::map<std::int32_t, std::int32_t>> number(out.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto p = static_cast<std::size_t>(pieces.of_triangle[t]);
    append(out[p], mesh.vertices, mesh.triangles[t], number[p]);
  }
  return out;
}

std::int64_t orient_alike(TriangleMesh& mesh) {
  const Neighbours near = neighbours(mesh);
  if (!near.manifold) return -1;
  std::vector<int> turn(mesh.triangles.size(), 0);
  bool one_sided = false;
  flood(
      mesh, near, [](std::size_t) {},
      [&](std::size_t from, const Link& link, bool seen) {
        int& to = turn[static_cast<std::size_t>(link.triangle)];
        const int wanted = link.agrees ? turn[from] : 1 - turn[from];
        if (!seen)
          to = wanted;
        else if (to != wanted)
          one_sided = true;
      });
  if (one_sided) return -1;
  std::int64_t turned = 0;
  for (std::size_t t = 0; t < turn.size(); ++t)
    if (turn[t]) {
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
      ++turned;
    }
  return turned;
}

std::vector<int> depths(const std::vector<TriangleMesh>& pieces) {
  std::vector<Box3> box;
  for (const TriangleMesh& piece : pieces) box.push_back(bounding_box(piece));
  std::vector<int> depth(pieces.size(), 0);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Vec3 point = pieces[p].vertices[0];
    for (std::size_t q = 0; q < pieces.size(); ++q)
      if (q != p && box[q].contains(point) && std::abs(winding_number(pieces[q], point)) > 0.5) ++depth[p];
  }
  return depth;
}

bool orient_outward(TriangleMesh& mesh) {
  if (orient_alike(mesh) < 0) return false;
  const Pieces parts = pieces(mesh);
  const std::vector<TriangleMesh> each = split(mesh, parts);
  const std::vector<int> depth = depths(each);
  std::vector<bool> wrong;
  for (std::size_t p = 0; p < each.size(); ++p)
    wrong.push_back((mass_properties(each[p]).volume > 0) != (depth[p] % 2 == 0));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (wrong[static_cast<std::size_t>(parts.of_triangle[t])])
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return true;
}

void turn_over(TriangleMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

double winding_number(const TriangleMesh& mesh, const Vec3& point) {
  double angle = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = corner(mesh, t, 0) - point, b = corner(mesh, t, 1) - point, c = corner(mesh, t, 2) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (2 * kPi);
}

TriangleMesh boundary(const TetMesh& mesh) {
  struct Face {
    std::array<std::int32_t, 3> key, turn;
  };
  std::vector<Face> faces;
  for (const auto& t : mesh.tets)
    for (const Triangle& f : {Triangle{t[0], t[2], t[1]}, Triangle{t[0], t[1], t[3]},
                              Triangle{t[1], t[2], t[3]}, Triangle{t[0], t[3], t[2]}}) {
      Triangle key = f;
      std::sort(key.begin(), key.end());
      faces.push_back({key, f});
    }
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
  TriangleMesh out;
  std::map<std::int32_t, std::int32_t> number;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t j = i + 1;
    while (j < faces.size() && faces[j].key == faces[i].key) ++j;
    if (j - i == 1) append(out, mesh.vertices, faces[i].turn, number);
    i = j;
  }
  return out;
}

}  // namespace packbed
