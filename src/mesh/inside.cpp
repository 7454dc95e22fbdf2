#include "mesh/inside.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>

#include "mesh/cgal_mesh.hpp"

namespace packbed {
namespace {

using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
using Traits = CGAL::AABB_traits<CgalKernel, Primitive>;
using Tree = CGAL::AABB_tree<Traits>;
using Side = CGAL::Side_of_triangle_mesh<CgalMesh, CgalKernel>;

CgalKernel::Point_3 point_of(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

struct MeshQuery::Impl {
  CgalMesh mesh;
  Tree tree;
  std::unique_ptr<Side> side;

  explicit Impl(const TriangleMesh& source)
      : mesh(to_cgal(source)), tree(faces(mesh).begin(), faces(mesh).end(), mesh) {
    // Built here, so that questions from several threads only read
    tree.build();
    tree.accelerate_distance_queries();
    side = std::make_unique<Side>(tree);
  }
};

MeshQuery::MeshQuery(const TriangleMesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
MeshQuery::~MeshQuery() = default;
MeshQuery::MeshQuery(MeshQuery&&) noexcept = default;
MeshQuery& MeshQuery::operator=(MeshQuery&&) noexcept = default;

bool MeshQuery::inside(const Vec3& point) const {
  return (*impl_->side)(point_of(point)) != CGAL::ON_UNBOUNDED_SIDE;
}

Vec3 MeshQuery::closest_point(const Vec3& point) const {
  const auto p = impl_->tree.closest_point(point_of(point));
  return {p.x(), p.y(), p.z()};
}

double MeshQuery::signed_distance(const Vec3& point) const {
  const double distance = (closest_point(point) - point).norm();
  return inside(point) ? -distance : distance;
}

std::vector<RayHit> MeshQuery::ray(const Vec3& from, const Vec3& direction) const {
  const CgalKernel::Ray_3 ray(point_of(from),
                              CgalKernel::Vector_3(direction.x(), direction.y(), direction.z()));
  std::vector<CgalMesh::Face_index> met;
  impl_->tree.all_intersected_primitives(ray, std::back_inserter(met));
  std::vector<RayHit> hits;
  for (const CgalMesh::Face_index face : met) {
    // The plane of the triangle rather than CGAL's intersection object, which is a segment for a grazed
    // triangle
    const auto h = impl_->mesh.halfedge(face);
    const auto at = [&](CgalMesh::Halfedge_index e) {
      const auto& p = impl_->mesh.point(impl_->mesh.target(e));
      return Vec3(p.x(), p.y(), p.z());
    };
    const Vec3 a = at(h), b = at(impl_->mesh.next(h)), c = at(impl_->mesh.prev(h));
    const Vec3 normal = (b - a).cross(c - a);
    const double towards = normal.dot(direction);
    if (towards == 0) continue;
    hits.push_back({normal.dot(a - from) / towards, static_cast<std::size_t>(face)});
  }
  std::sort(hits.begin(), hits.end(), [](const RayHit& x, const RayHit& y) {
    return std::make_pair(x.distance, x.triangle) < std::make_pair(y.distance, y.triangle);
  });
  return hits;
}

}  // namespace packbed
