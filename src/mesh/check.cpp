#include "mesh/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/inside.hpp"
#include "mesh/repair.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

constexpr std::size_t kCrossingsToCount = 1000;
constexpr double kTextDigits = 1e-7;  // of the diagonal: what single precision or a short text file can lose
constexpr double kFlatSolid = 1e-9;   // volume below this fraction of the cube of the diagonal is none

std::string at(const Vec3& place) {
  return fmt::format("at ({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * place.x(), 1e3 * place.y(), 1e3 * place.z());
}

std::string counted(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

// One check after the other on one report; each returns false when the later ones have no meaning any more.
class Checker {
 public:
  Checker(MeshReport& report, const MeshCheckOptions& options)
      : report_(report), mesh_(report.mesh), options_(options) {}

  void all() {
    if (!has_triangles() || !indices_valid() || !finite()) return;
    diagonal_ = bounding_box(mesh_).diagonal().norm();
    report_.welded = weld(mesh_);
    // What lies inside what has no meaning before it is known that nothing crosses
    if (!not_degenerate() || !closed() || !manifold() || !oriented() || !uncrossed() || !outward()) return;
    one_solid();
    walls();
  }

 private:
  void find(MeshProblem problem, bool fatal, std::size_t count, const Vec3& place, std::string sentence) {
    report_.findings.push_back({problem, fatal, count, place, std::move(sentence)});
  }

  bool has_triangles() {
    if (!mesh_.triangles.empty()) return true;
    find(MeshProblem::empty, true, 0, Vec3::Zero(), "the mesh has no triangles");
    return false;
  }

  bool indices_valid() {
    const auto n = static_cast<std::int32_t>(mesh_.vertices.size());
    std::size_t count = 0;
    for (const auto& t : mesh_.triangles)
      count += std::any_of(t.begin(), t.end(), [&](std::int32_t v) { return v < 0 || v >= n; });
    if (count == 0) return true;
    find(MeshProblem::bad_index, true, count, Vec3::Zero(),
         fmt::format("{} a vertex that the file does not have (it has {})",
                     counted(count, "triangle names", "triangles name"), n));
    return false;
  }

  bool finite() {
    std::size_t count = 0, first = 0;
    for (std::size_t v = mesh_.vertices.size(); v-- > 0;)
      if (!mesh_.vertices[v].allFinite() || mesh_.vertices[v].cwiseAbs().maxCoeff() > 1e30) {
        ++count;
        first = v;
      }
    if (count == 0) return true;
    find(MeshProblem::not_finite, true, count, Vec3::Zero(),
         fmt::format("{} a coordinate that is not a finite number, the first is vertex {}",
                     counted(count, "vertex has", "vertices have"), first + 1));
    return false;
  }

  bool not_degenerate() {
    const std::size_t before = mesh_.triangles.size();
    const std::vector<std::size_t> flat = degenerate_triangles(mesh_);
    if (flat.empty()) return true;
    const Vec3 place = triangle_centre(mesh_, mesh_.triangles[flat.front()]);
    const std::size_t left = options_.repair ? drop_degenerate(mesh_) : flat.size();
    const bool fatal = left > 0 || mesh_.triangles.empty();
    find(MeshProblem::degenerate, fatal, flat.size(), place,
         fmt::format("{} of {} without area, the first {}{}", counted(flat.size(), "triangle", "triangles"),
                     before, at(place), fatal ? "" : "; removed without changing the surface"));
    return !fatal;
  }

  // Edges with one triangle; tries once more with vertices joined that differ by no more than a text file
  // loses.
  bool closed() {
    std::pair<std::size_t, Vec3> gaps = open_edges(mesh_);
    if (gaps.first > 0 && options_.repair) {
      TriangleMesh joined = mesh_;
      const std::size_t merged_now = weld_within(joined, kTextDigits * diagonal_);
      drop_degenerate(joined);
      if (merged_now > 0 && !joined.triangles.empty() && open_edges(joined).first == 0) {
        find(MeshProblem::open, false, gaps.first, gaps.second,
             fmt::format("{} of one triangle only, the first {}; closed by joining {} nearer than {:.2g} mm",
                         counted(gaps.first, "edge", "edges"), at(gaps.second),
                         counted(merged_now, "vertex", "vertices"), 1e3 * kTextDigits * diagonal_));
        report_.welded += merged_now;
        mesh_ = std::move(joined);
        return true;
      }
    }
    if (gaps.first == 0) return true;
    find(MeshProblem::open, true, gaps.first, gaps.second,
         fmt::format("the surface is open: {} one triangle only, the first {}",
                     counted(gaps.first, "edge has", "edges have"), at(gaps.second)));
    return false;
  }

  static std::pair<std::size_t, Vec3> open_edges(const TriangleMesh& mesh) {
    const std::vector<EdgeUse> uses = edge_uses(mesh);
    std::size_t count = 0;
    Vec3 place = Vec3::Zero();
    for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
      for (j = i; j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high;) ++j;
      if (j - i != 1) continue;
      if (count++ == 0) place = middle(mesh, uses[i]);
    }
    return {count, place};
  }

  static Vec3 middle(const TriangleMesh& mesh, const EdgeUse& e) {
    return 0.5 *
           (mesh.vertices[static_cast<std::size_t>(e.low)] + mesh.vertices[static_cast<std::size_t>(e.high)]);
  }

  bool manifold() {
    const std::vector<EdgeUse> uses = edge_uses(mesh_);
    std::size_t count = 0;
    Vec3 place = Vec3::Zero();
    for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
      for (j = i; j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high;) ++j;
      if (j - i > 2 && count++ == 0) place = middle(mesh_, uses[i]);
    }
    if (count > 0) {
      find(MeshProblem::not_manifold, true, count, place,
           fmt::format("{} more than two triangles, the first {}: sheets meet there",
                       counted(count, "edge has", "edges have"), at(place)));
      return false;
    }
    return no_pinched_vertex();
  }

  // The triangles round a vertex must form one fan: as many triangles as one walk from edge to edge meets.
  bool no_pinched_vertex() {
    std::vector<std::size_t> around(mesh_.vertices.size(), 0), fans(mesh_.vertices.size(), 0);
    // next[(triangle, corner)]: union of corners of one vertex that share an edge
    std::vector<std::size_t> parent(3 * mesh_.triangles.size());
    for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = i;
    const auto root = [&](std::size_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    const auto corner_of = [&](std::int32_t triangle, std::int32_t vertex) {
      const auto& t = mesh_.triangles[static_cast<std::size_t>(triangle)];
      const std::size_t k = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
      return 3 * static_cast<std::size_t>(triangle) + k;
    };
    const std::vector<EdgeUse> uses = edge_uses(mesh_);
    for (std::size_t i = 0; i + 1 < uses.size(); i += 2)
      for (const std::int32_t v : {uses[i].low, uses[i].high})
        parent[root(corner_of(uses[i].triangle, v))] = root(corner_of(uses[i + 1].triangle, v));
    for (std::size_t i = 0; i < parent.size(); ++i)
      if (root(i) == i) ++fans[static_cast<std::size_t>(mesh_.triangles[i / 3][i % 3])];
    std::size_t count = 0;
    Vec3 place = Vec3::Zero();
    for (std::size_t v = 0; v < fans.size(); ++v)
      if (fans[v] > 1 && count++ == 0) place = mesh_.vertices[v];
    if (count == 0) return true;
    find(MeshProblem::not_manifold, true, count, place,
         fmt::format("{} two sheets that meet in nothing but that point, the first {}",
                     counted(count, "vertex joins", "vertices join"), at(place)));
    return false;
  }

  bool oriented() {
    TriangleMesh turned = mesh_;
    const std::int64_t count = orient_alike(turned);
    if (count == 0) return true;
    const bool fixed = count > 0 && options_.repair;
    const Vec3 place = first_disagreement();
    const std::size_t n = static_cast<std::size_t>(std::max<std::int64_t>(count, 1));
    const std::size_t smaller = std::min(n, mesh_.triangles.size() - n);
    find(MeshProblem::inconsistent, !fixed, smaller, place,
         count < 0 ? fmt::format("the surface has one side only (as a Möbius strip), seen {}", at(place))
                   : fmt::format("{} the other way round than their neighbours, the first {}{}",
                                 counted(smaller, "triangle runs", "triangles run"), at(place),
                                 fixed ? "; turned" : ""));
    if (!fixed) return false;
    mesh_ = std::move(turned);
    reoriented_ = true;
    return true;
  }

  Vec3 first_disagreement() const {
    const std::vector<EdgeUse> uses = edge_uses(mesh_);
    for (std::size_t i = 0; i + 1 < uses.size(); i += 2)
      if (uses[i].forward == uses[i + 1].forward) return middle(mesh_, uses[i]);
    return Vec3::Zero();
  }

  // How many other pieces hold the piece; its sign must be that of material (even) or of a hole (odd).
  bool outward() {
    const Pieces parts = pieces(mesh_);
    const std::vector<TriangleMesh> piece = split(mesh_, parts);
    std::vector<double> volume;
    for (const TriangleMesh& p : piece) {
      volume.push_back(mass_properties(p).volume);
      const double size = bounding_box(p).diagonal().norm();
      if (std::abs(volume.back()) > kFlatSolid * size * size * size) continue;
      find(MeshProblem::no_volume, true, 1, p.vertices[0],
           fmt::format("a closed piece without volume, {}", at(p.vertices[0])));
      return false;
    }
    const std::vector<int> depth = depths(piece);
    std::vector<bool> wrong;
    for (std::size_t p = 0; p < piece.size(); ++p) {
      ++(depth[p] % 2 == 0 ? report_.solids : report_.cavities);
      wrong.push_back((volume[p] > 0) != (depth[p] % 2 == 0));
    }
    return turn_wrong(parts, wrong);
  }

  bool turn_wrong(const Pieces& parts, const std::vector<bool>& wrong) {
    const auto count = static_cast<std::size_t>(std::count(wrong.begin(), wrong.end(), true));
    if (count == 0) return true;
    const bool whole = count == wrong.size();
    // A single piece that disagrees with the others may be a hole or a body inside a body: the file must say
    const bool fixed = options_.repair && (whole || reoriented_);
    const auto first = static_cast<std::size_t>(std::find(wrong.begin(), wrong.end(), true) - wrong.begin());
    Vec3 place = Vec3::Zero();
    for (std::size_t t = mesh_.triangles.size(); t-- > 0;)
      if (static_cast<std::size_t>(parts.of_triangle[t]) == first)
        place = triangle_centre(mesh_, mesh_.triangles[t]);
    if (!reoriented_ || !fixed)
      find(
          MeshProblem::inverted, !fixed, count, place,
          whole
              ? fmt::format("the surface is inside out{}", fixed ? "; turned" : "")
              : fmt::format(
                    "{} of {} inside out (a body turned as a hole, or a hole turned as a body), the first {}",
                    counted(count, "piece", "pieces"), wrong.size(), at(place)));
    if (!fixed) return false;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (wrong[static_cast<std::size_t>(parts.of_triangle[t])])
        std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
    return true;
  }

  void one_solid() {
    if (report_.solids <= 1) return;
    find(MeshProblem::several_solids, !options_.several_solids, static_cast<std::size_t>(report_.solids),
         triangle_centre(mesh_, mesh_.triangles.back()),
         fmt::format("{} separate solids{}", report_.solids,
                     options_.several_solids ? "" : ", one is needed"));
  }

  bool uncrossed() {
    if (!options_.crossings) return true;
    const auto pairs = self_crossings(mesh_, kCrossingsToCount);
    if (pairs.empty()) return true;
    const Vec3 place = triangle_centre(mesh_, mesh_.triangles[pairs.front().first]);
    find(MeshProblem::self_crossing, true, pairs.size(), place,
         fmt::format("the surface crosses itself: {}{} of triangles cut each other, the first {}",
                     pairs.size() >= kCrossingsToCount ? "at least " : "",
                     counted(pairs.size(), "pair", "pairs"), at(place)));
    return false;
  }

  void walls() {
    if (!options_.walls) return;
    const Thickness wall = thinnest_wall(mesh_);
    report_.thinnest_wall = wall.value;
    report_.thinnest_place = wall.place;
    const double size = bounding_box(mesh_).sizes().maxCoeff();
    if (wall.value == 0 || wall.value >= kThinWall * size) return;
    find(MeshProblem::thin_wall, false, 1, wall.place,
         fmt::format("a wall of {:.4g} mm ({:.2g} of the size) {}: overlaps of more than half of it would "
                     "pass through",
                     1e3 * wall.value, wall.value / size, at(wall.place)));
  }

  MeshReport& report_;
  TriangleMesh& mesh_;
  const MeshCheckOptions& options_;
  double diagonal_ = 0;
  bool reoriented_ = false;
};

}  // namespace

std::string_view to_string(MeshProblem problem) {
  switch (problem) {
    case MeshProblem::empty:
      return "empty";
    case MeshProblem::bad_index:
      return "bad index";
    case MeshProblem::not_finite:
      return "not finite";
    case MeshProblem::degenerate:
      return "degenerate triangles";
    case MeshProblem::open:
      return "open";
    case MeshProblem::not_manifold:
      return "not manifold";
    case MeshProblem::inconsistent:
      return "inconsistent orientation";
    case MeshProblem::inverted:
      return "inverted";
    case MeshProblem::self_crossing:
      return "self-crossing";
    case MeshProblem::several_solids:
      return "several solids";
    case MeshProblem::no_volume:
      return "no volume";
    case MeshProblem::thin_wall:
      return "thin wall";
  }
  return "";
}

const MeshFinding* MeshReport::fatal() const {
  for (const MeshFinding& f : findings)
    if (f.fatal) return &f;
  return nullptr;
}

bool MeshReport::has(MeshProblem problem) const {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const MeshFinding& f) { return f.problem == problem; });
}

MeshReport check_mesh(const TriangleMesh& mesh, const MeshCheckOptions& options) {
  MeshReport report;
  report.mesh = mesh;
  Checker(report, options).all();
  return report;
}

}  // namespace packbed
