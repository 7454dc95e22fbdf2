#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "io/cad_reader/readers.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

constexpr double kTetSides = 12;  // of a circle, for tetrahedra whose size nobody gave

constexpr double kSmallestFacet = 1.0 / 200;  // of the diagonal, for chord errors that ask for smaller ones

struct Session {
  Session() {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.ExpertMode", 1);  // never ask
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::option::setNumber("Mesh.MeshSizeMin", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);  // else a tenth of the diagonal everywhere
  }
};

// Nodes of the current model as vertices, and the way back from gmsh's tags.
struct Nodes {
  std::vector<Vec3> vertices;
  std::unordered_map<std::size_t, std::int32_t> number;

  explicit Nodes(double scale) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    for (std::size_t i = 0; i < tags.size() && 3 * i + 2 < coordinates.size(); ++i) {
      number.emplace(tags[i], static_cast<std::int32_t>(vertices.size()));
      vertices.emplace_back(scale * coordinates[3 * i], scale * coordinates[3 * i + 1],
                            scale * coordinates[3 * i + 2]);
    }
  }
  std::int32_t operator[](std::size_t tag) const {
    const auto at = number.find(tag);
    return at == number.end() ? -1 : at->second;
  }
};

// gmsh's element types: corners that count, of how many nodes
struct ElementKind {
  int type;
  const char* name;
  std::size_t corners, nodes;
};
constexpr ElementKind kTriangle{2, "triangle", 3, 3}, kTriangle6{9, "second-order triangle", 3, 6},
    kQuad{3, "quadrangle", 4, 4}, kTet{4, "tetrahedron", 4, 4}, kTet10{11, "second-order tetrahedron", 4, 10};

// Calls take(corner numbers) for every element of a kind; returns how many there are.
template <class Take>
std::size_t each_element(const ElementKind& kind, const Nodes& nodes, const Take& take) {
  std::vector<std::size_t> tags, node_tags;
  gmsh::model::mesh::getElementsByType(kind.type, tags, node_tags);
  const std::size_t n = node_tags.size() / kind.nodes;
  std::vector<std::int32_t> corners(kind.corners);
  for (std::size_t e = 0; e < n; ++e) {
    for (std::size_t k = 0; k < kind.corners; ++k) corners[k] = nodes[node_tags[e * kind.nodes + k]];
    take(corners);
  }
  return n;
}

TriangleMesh triangles_now(const Nodes& nodes, CadMessage& out) {
  TriangleMesh mesh;
  mesh.vertices = nodes.vertices;
  const auto triangle = [&](const std::vector<std::int32_t>& c) {
    mesh.triangles.push_back({c[0], c[1], c[2]});
  };
  each_element(kTriangle, nodes, triangle);
  const std::size_t curved = each_element(kTriangle6, nodes, triangle);
  const std::size_t quads = each_element(kQuad, nodes, [&](const std::vector<std::int32_t>& c) {
    mesh.triangles.push_back({c[0], c[1], c[2]});
    mesh.triangles.push_back({c[0], c[2], c[3]});
  });
  if (curved > 0) out.notes.push_back(fmt::format("{} second-order triangles were made flat", curved));
  if (quads > 0) out.notes.push_back(fmt::format("{} quadrangles were cut into triangles", quads));
  return mesh;
}

TetMesh tets_now(const Nodes& nodes, CadMessage& out) {
  TetMesh mesh;
  mesh.vertices = nodes.vertices;
  const auto valid = [&](std::int32_t v) {
    return v >= 0 && static_cast<std::size_t>(v) < mesh.vertices.size();
  };
  const auto tet = [&](const std::vector<std::int32_t>& c) {
    if (!std::all_of(c.begin(), c.end(), valid))
      throw Unusable("a tetrahedron names a node that is not there");
    mesh.tets.push_back({c[0], c[1], c[2], c[3]});
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(c[k])]; };
    if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0)
      std::swap(mesh.tets.back()[2], mesh.tets.back()[3]);
  };
  each_element(kTet, nodes, tet);
  const std::size_t curved = each_element(kTet10, nodes, tet);
  if (curved > 0) out.notes.push_back(fmt::format("{} second-order tetrahedra were made straight", curved));
  return mesh;
}

// Keeps the vertices that tetrahedra use.
TetMesh compact(const TetMesh& mesh) {
  TetMesh out;
  std::vector<std::int32_t> number(mesh.vertices.size(), -1);
  for (auto t : mesh.tets) {
    for (std::int32_t& v : t) {
      std::int32_t& n = number[static_cast<std::size_t>(v)];
      if (n < 0) {
        n = static_cast<std::int32_t>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
      }
      v = n;
    }
    out.tets.push_back(t);
  }
  return out;
}

std::size_t count_words(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size())) ++n;
  return n;
}

std::string whole_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Sends what the CAD kernel knows of the solids: exact volume and area. Its lengths are millimetres here.
void measure(const gmsh::vectorpair& solids, CadMessage& out) {
  double volume = 0, area = 0;
  for (const auto& [dim, tag] : solids) {
    double v = 0;
    gmsh::model::occ::getMass(dim, tag, v);
    volume += v;
    gmsh::vectorpair faces;
    gmsh::model::getBoundary({{dim, tag}}, faces, true, false, false);
    for (const auto& face : faces) {
      double a = 0;
      gmsh::model::occ::getMass(face.first, std::abs(face.second), a);
      area += a;
    }
  }
  if (!std::isfinite(volume) || !(volume > 0)) throw Unusable(fmt::format("a volume of {:.4g} mm3", volume));
  out.volume = 1e-9 * volume;
  out.area = 1e-6 * area;
}

double smallest_extent(const std::vector<Vec3>& vertices) {
  Box3 box;
  for (const Vec3& v : vertices) box.extend(v);
  return box.sizes().minCoeff();
}

// [mm]. A rounding of a thousandth of the body needs no sixty facets of its own.
double smallest_facet(const gmsh::vectorpair& solids) {
  Box3 box;
  for (const auto& [dim, tag] : solids) {
    double a[6];
    gmsh::model::getBoundingBox(dim, tag, a[0], a[1], a[2], a[3], a[4], a[5]);
    box.extend(Vec3(a[0], a[1], a[2])).extend(Vec3(a[3], a[4], a[5]));
  }
  return kSmallestFacet * box.diagonal().norm();
}

}  // namespace

CadMessage read_step(const CadRequest& request) {
  constexpr double kMillimetre = 1e-3;
  CadMessage out;
  const std::string text = whole_file(request.path);
  const std::size_t named = count_words(text, "MANIFOLD_SOLID_BREP") + count_words(text, "BREP_WITH_VOIDS");
  Session session;
  gmsh::option::setString("Geometry.OCCTargetUnit", "MM");
  gmsh::vectorpair imported, solids;
  gmsh::model::occ::importShapes(request.path, imported, true, "step");
  gmsh::model::occ::synchronize();
  gmsh::model::getEntities(solids, 3);
  if (solids.empty())
    throw Unusable(named > 0 ? "solids that the CAD kernel cannot build"
                             : "no solid, only surfaces, curves or nothing");
  if (solids.size() < named)
    throw Unusable(fmt::format("{} solids of which the CAD kernel can build {}", named, solids.size()));
  out.solids = static_cast<int>(solids.size());
  measure(solids, out);
  const double facets = std::ceil(kPi / std::acos(1 - std::clamp(request.chord_error, 1e-6, 0.5)));
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", facets);
  gmsh::option::setNumber("Mesh.MeshSizeMin", smallest_facet(solids));
  gmsh::model::mesh::generate(2);
  out.mesh = triangles_now(Nodes(kMillimetre), out);
  if (!orient_outward(out.mesh)) throw Unusable("faces that do not close to solids");
  const double volume = mass_properties(out.mesh).volume;
  if (!(std::abs(volume / *out.volume - 1) < std::max(0.05, 5 * request.chord_error)))
    throw Unusable(fmt::format("faces that hold {:.4g} mm3 round a solid of {:.4g} mm3", 1e9 * volume,
                               1e9 * *out.volume));
  out.detail = fmt::format("STEP, faceted with {} sides a circle", static_cast<int>(facets));
  if (!request.want_tets) return out;
  const double size = request.tet_size > 0 ? request.tet_size : smallest_extent(out.mesh.vertices) / 3;
  gmsh::model::mesh::clear();
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", request.tet_size > 0 ? 0 : kTetSides);
  gmsh::option::setNumber("Mesh.MeshSizeMax", size / kMillimetre);
  gmsh::model::mesh::generate(3);
  out.tets = compact(tets_now(Nodes(kMillimetre), out));
  if (out.tets->tets.empty()) throw Unusable("a solid that cannot be filled with tetrahedra");
  return out;
}

CadMessage read_msh(const CadRequest& request) {
  CadMessage out;
  Session session;
  gmsh::merge(request.path);
  const Nodes nodes(request.scale);
  TetMesh tets = compact(tets_now(nodes, out));
  int model_dimension = 0;
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types);
  for (const int type : types) {
    std::string name;
    int dimension = 0, order = 0, count = 0, primary = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, count, local, primary);
    model_dimension = std::max(model_dimension, dimension);
    if (dimension == 3 && type != kTet.type && type != kTet10.type)
      throw Unusable(fmt::format("elements of the kind {}; only tetrahedra can be read", name));
  }
  if (model_dimension < 2) throw Unusable("no triangles and no tetrahedra");
  if (tets.tets.empty()) {
    out.mesh = triangles_now(nodes, out);
    out.detail = fmt::format("MSH, a surface of {} triangles", out.mesh.triangles.size());
    return out;
  }
  out.mesh = boundary(tets);
  out.detail = fmt::format("MSH, {} tetrahedra", tets.tets.size());
  if (request.want_tets) out.tets = std::move(tets);
  return out;
}

TetMesh fill_with_tets(const TriangleMesh& mesh, double size) {
  // In units of the body's size: gmsh's tolerances are absolute
  const Box3 box = bounding_box(mesh);
  const double unit = box.sizes().maxCoeff();
  Session session;
  gmsh::model::add("body");
  gmsh::model::addDiscreteEntity(2, 1);
  std::vector<std::size_t> tags, elements, corners;
  std::vector<double> coordinates;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    tags.push_back(i + 1);
    for (int k = 0; k < 3; ++k) coordinates.push_back((mesh.vertices[i][k] - box.center()[k]) / unit);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    elements.push_back(t + 1);
    for (const std::int32_t v : mesh.triangles[t]) corners.push_back(static_cast<std::size_t>(v) + 1);
  }
  gmsh::model::mesh::addNodes(2, 1, tags, coordinates);
  gmsh::model::mesh::addElementsByType(1, kTriangle.type, elements, corners);
  gmsh::model::geo::addSurfaceLoop({1}, 1);
  gmsh::model::geo::addVolume({1}, 1);
  gmsh::model::geo::synchronize();
  gmsh::option::setNumber("Mesh.MeshSizeMax", (size > 0 ? size : box.sizes().minCoeff() / 3) / unit);
  gmsh::model::mesh::generate(3);
  CadMessage unused;
  TetMesh tets = compact(tets_now(Nodes(unit), unused));
  if (tets.tets.empty()) throw Unusable("a surface that cannot be filled with tetrahedra");
  for (Vec3& v : tets.vertices) v += box.center();
  return tets;
}

}  // namespace packbed
