#include "packers/overlap_test.hpp"

#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>

#include "mesh/convex.hpp"

namespace packbed {
namespace {

// FCL's tolerances are absolute: at metres it misses shallow touches of millimetre pellets. All lengths are
// divided by the bounding radius of the first pellet of a pair, and the tolerance is far below any overlap
// that matters.
constexpr double kTolerance = 1e-10;
// Entering pellets are grown by this fraction, so that a touch within rounding counts as overlap.
constexpr double kMargin = 1e-7;

std::shared_ptr<const std::vector<int>> faces_for_fcl(const TriangleMesh& mesh) {
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& t : mesh.triangles) faces->insert(faces->end(), {3, t[0], t[1], t[2]});
  return faces;
}

fcl::Transform3d placed_at(const Quat& rotation, const Vec3& position) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = rotation.toRotationMatrix();
  transform.translation() = position;
  return transform;
}

}  // namespace

struct OverlapTest::Body {
  ShapePtr shape;
  bool convex = true;
  std::shared_ptr<const std::vector<int>> faces;  // of a convex mesh

  std::unique_ptr<fcl::CollisionGeometryd> scaled(double scale) const {
    const Shape& s = *shape;
    if (s.kind == ShapeClass::sphere) return std::make_unique<fcl::Sphered>(s.radius * scale);
    if (s.kind == ShapeClass::cylinder)
      return std::make_unique<fcl::Cylinderd>(s.radius * scale, 2 * s.half_height * scale);
    auto vertices = std::make_shared<std::vector<Vec3>>(s.surface.vertices);
    for (Vec3& v : *vertices) v *= scale;
    return std::make_unique<fcl::Convexd>(vertices, static_cast<int>(s.surface.triangles.size()), faces);
  }
};

OverlapTest::OverlapTest(const std::vector<PelletKind>& kinds) {
  for (const PelletKind& kind : kinds) {
    auto body = std::make_unique<Body>();
    body->shape = kind.shape;
    if (seen_as_mesh(kind.shape->kind)) {
      body->convex = !convex_planes(kind.shape->surface).empty();
      if (body->convex) body->faces = faces_for_fcl(kind.shape->surface);
    }
    bodies_.push_back(std::move(body));
  }
}

OverlapTest::~OverlapTest() = default;

double OverlapTest::bounding_radius(const Pellet& pellet) const {
  const Shape& shape = *bodies_[pellet.shape]->shape;  // a sphere's own bounding radius holds its facets too
  return (shape.kind == ShapeClass::sphere ? shape.radius : shape.bounding_radius) * pellet.scale;
}

bool OverlapTest::exact(std::uint32_t shape) const {
  return bodies_[shape]->convex;
}

bool OverlapTest::overlap(const Pellet& a, const Pellet& b) const {
  const double reach = (bounding_radius(a) + bounding_radius(b)) * (1 + kMargin);
  const Vec3 apart = b.pose.position - a.pose.position;
  if (apart.squaredNorm() > reach * reach) return false;
  const Body &body_a = *bodies_[a.shape], &body_b = *bodies_[b.shape];
  if (!body_a.convex || !body_b.convex) return true;
  if (body_a.shape->kind == ShapeClass::sphere && body_b.shape->kind == ShapeClass::sphere) return true;

  const double unit = 1 / bounding_radius(a);
  const auto geometry_a = body_a.scaled(a.scale * unit * (1 + kMargin));
  const auto geometry_b = body_b.scaled(b.scale * unit);
  fcl::CollisionRequestd request(1, false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.gjk_tolerance = kTolerance;
  fcl::CollisionResultd result;
  try {
    fcl::collide(geometry_a.get(), placed_at(a.pose.rotation, Vec3::Zero()), geometry_b.get(),
                 placed_at(b.pose.rotation, apart * unit), request, result);
  } catch (const std::exception&) {
    return true;  // GJK gave up on a degenerate pose: overlapping is the safe answer
  }
  return result.isCollision();
}

double OverlapTest::depth(const Pellet& a, const Pellet& b) const {
  const double reach = bounding_radius(a) + bounding_radius(b);
  const Vec3 apart = b.pose.position - a.pose.position;
  if (apart.squaredNorm() >= reach * reach) return 0;
  const Body &body_a = *bodies_[a.shape], &body_b = *bodies_[b.shape];
  if (!body_a.convex || !body_b.convex) return 0;
  if (body_a.shape->kind == ShapeClass::sphere && body_b.shape->kind == ShapeClass::sphere)
    return reach - apart.norm();

  const double unit = 1 / bounding_radius(a);
  const auto geometry_a = body_a.scaled(a.scale * unit), geometry_b = body_b.scaled(b.scale * unit);
  fcl::CollisionRequestd request(1, true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.gjk_tolerance = kTolerance;
  fcl::CollisionResultd result;
  try {
    fcl::collide(geometry_a.get(), placed_at(a.pose.rotation, Vec3::Zero()), geometry_b.get(),
                 placed_at(b.pose.rotation, apart * unit), request, result);
  } catch (const std::exception&) {
    return reach - apart.norm();  // known EPA failures (FCL issues 319, 493): the safe bound
  }
  if (!result.isCollision()) return 0;
  double deepest = 0;
  for (std::size_t i = 0; i < result.numContacts(); ++i)
    deepest = std::max(deepest, std::abs(result.getContact(i).penetration_depth));
  return deepest / unit;
}

}  // namespace packbed
