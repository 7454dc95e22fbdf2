#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include "mesh/cgal_mesh.hpp"
#include "mesh/inside.hpp"

namespace packbed {
namespace {

struct Enough {};

// Collects pairs and stops the search when there are enough.
struct Collector {
  using Pair = std::pair<CgalMesh::Face_index, CgalMesh::Face_index>;
  std::vector<std::pair<std::size_t, std::size_t>>* found;
  std::size_t limit;

  Collector& operator*() { return *this; }
  Collector& operator++() { return *this; }
  Collector& operator++(int) { return *this; }
  Collector& operator=(const Pair& p) {
    found->emplace_back(static_cast<std::size_t>(p.first), static_cast<std::size_t>(p.second));
    if (found->size() >= limit) throw Enough();
    return *this;
  }
};

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> self_crossings(const TriangleMesh& mesh, std::size_t limit) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  const CgalMesh surface = to_cgal(mesh);
  try {
    CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(surface,
                                                                            Collector{&found, limit});
  } catch (const Enough&) {  // the first `limit` will do
  }
  return found;
}

}  // namespace packbed
