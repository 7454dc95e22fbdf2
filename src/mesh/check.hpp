#pragma once
// Is this mesh the boundary of a solid? Each thing that is wrong has a reason, a count and a place.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.hpp"

namespace packbed {

/// Why a mesh cannot (fatal) or should not be used. In the order in which they are looked for: a mesh that
/// fails early is not asked the later, costlier questions.
enum class MeshProblem {
  empty,           // no triangles
  bad_index,       // a triangle names a vertex that is not there
  not_finite,      // NaN or infinite coordinates
  degenerate,      // triangles without area: repaired when dropping them leaves the mesh whole
  open,            // edges with one triangle only
  not_manifold,    // an edge with three or more triangles, or two sheets that meet in one point
  inconsistent,    // neighbouring triangles that turn opposite ways: repaired where the surface has two sides
  self_crossing,   // triangles that cut each other
  no_volume,       // closed, but flat
  inverted,        // inside out: repaired when the whole mesh is
  several_solids,  // more than one piece of material
  thin_wall        // a wall thinner than kThinWall of the size
};
std::string_view to_string(MeshProblem);

struct MeshFinding {
  MeshProblem problem;
  bool fatal = true;          // false: repaired, or only worth knowing
  std::size_t count = 0;      // of triangles, edges, vertices or pieces, as the sentence says
  Vec3 place = Vec3::Zero();  // where the first one is [m]
  std::string sentence;       // with count and place, for people
};

struct MeshCheckOptions {
  bool several_solids = false;  // more than one piece is fine (containers)
  bool repair = true;           // weld, drop degenerate triangles, turn an inverted mesh: each with a finding
  bool crossings = true;        // look for self-crossing (the costliest question: about 1 us a triangle)
  bool walls = true;            // measure the thinnest wall
};

struct MeshReport {
  TriangleMesh mesh;  // welded and repaired; outward when nothing is fatal
  std::vector<MeshFinding> findings;
  std::size_t welded = 0;              // vertices that were copies of another (STL has six a vertex)
  int solids = 0;                      // pieces of material
  int cavities = 0;                    // closed holes inside them
  double thinnest_wall = 0;            // [m]; 0: not measured (see thinnest_wall below)
  Vec3 thinnest_place = Vec3::Zero();  // where [m]
  const MeshFinding* fatal() const;    // the first fatal finding, or nullptr
  bool has(MeshProblem problem) const;
};

/// Never throws for a bad mesh: says what is wrong with it.
MeshReport check_mesh(const TriangleMesh& mesh, const MeshCheckOptions& options = {});

/// A wall thinner than this fraction of the body's size gets a (not fatal) finding.
inline constexpr double kThinWall = 0.01;

struct Thickness {
  double value = 0;           // [m]; 0: no wall was found
  Vec3 place = Vec3::Zero();  // on the surface [m]
};
/// Thinnest wall of a closed outward mesh: the shortest way straight through the material, from points spread
/// over the surface (at least one a triangle) to a triangle that faces back within 45 degrees; an edge that
/// runs out to nothing is no wall. A convex body's smallest width is taken instead where that is smaller.
Thickness thinnest_wall(const TriangleMesh& mesh);

}  // namespace packbed
