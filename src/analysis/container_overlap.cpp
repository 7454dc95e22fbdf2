#include "analysis/container_overlap.hpp"

#include <algorithm>
#include <cmath>

#include "bed/pellet_box.hpp"

namespace packbed {
namespace {

struct FarPoint {
  double distance = 0;  // from the z axis [m]
  Vec3 point = Vec3::Zero();
};

/// The point of a circle (centre c, unit normal a) furthest from the z axis. Seen from above it is an ellipse
/// with axes `radius` along a horizontal u and radius |a_z| across it; the distance has at most two maxima
/// round it, which a scan of 32 points brackets and Newton's method finishes.
FarPoint furthest_of_circle(const Vec3& c, const Vec3& a, double radius) {
  const Vec3 flat(-a.y(), a.x(), 0);
  const Vec3 u = flat.norm() > 1e-12 ? Vec3(flat.normalized()) : Vec3::UnitX(), v = a.cross(u);
  const auto at = [&](double t) { return Vec3(c + radius * (std::cos(t) * u + std::sin(t) * v)); };
  double best = 0, most = -1;
  for (int i = 0; i < 32; ++i) {
    const double t = 2 * kPi * i / 32, d = at(t).head<2>().squaredNorm();
    if (d > most) {
      most = d;
      best = t;
    }
  }
  for (int k = 0; k < 20; ++k) {  // of half the squared distance, by its first two derivatives
    const Eigen::Vector2d p = at(best).head<2>(),
                          d1 = radius * (-std::sin(best) * u + std::cos(best) * v).head<2>(),
                          d2 = -radius * (std::cos(best) * u + std::sin(best) * v).head<2>();
    const double slope = p.dot(d1), bend = d1.squaredNorm() + p.dot(d2);
    if (!(bend < 0)) break;
    const double step = std::clamp(-slope / bend, -0.2, 0.2);
    best += step;
    if (std::abs(step) < 1e-14) break;
  }
  return {at(best).head<2>().norm(), at(best)};
}

FarPoint furthest_from_axis(const Shape& shape, const Pellet& pellet) {
  const Vec3& c = pellet.pose.position;
  FarPoint far;
  if (shape.kind == ShapeClass::sphere) {
    const double radius = pellet.scale * shape.radius, off = c.head<2>().norm();
    const Vec3 out = off > 0 ? Vec3(c.x() / off, c.y() / off, 0) : Vec3::UnitX();
    return {off + radius, c + radius * out};
  }
  if (shape.kind == ShapeClass::cylinder ||
      shape.kind == ShapeClass::tube) {  // the distance is a convex function: its maximum is on a rim
    const Vec3 a = pellet.pose.rotation * Vec3::UnitZ(), up = pellet.scale * shape.half_height * a;
    const FarPoint p = furthest_of_circle(c + up, a, pellet.scale * shape.radius),
                   q = furthest_of_circle(c - up, a, pellet.scale * shape.radius);
    return p.distance > q.distance ? p : q;
  }
  for (const Vec3& v : shape.surface.vertices) {
    const Vec3 p = pellet.pose.to_world(pellet.scale * v);
    if (const double d = p.head<2>().norm(); d > far.distance) far = {d, p};
  }
  return far;
}

Overlap with_container(std::size_t i, double depth, const Body& body, const Vec3& point) {
  return {static_cast<std::uint32_t>(i), kContainer, depth, depth / body.thickness(), 0, point};
}

void add_floor(const PackedBed& bed, const std::vector<Body>& bodies, std::vector<Overlap>& overlaps) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Pellet& p = bed.pellets[i];
    const double depth = reach(*bed.shapes[p.shape], p, -Vec3::UnitZ());
    if (depth > 0)
      overlaps.push_back(with_container(i, depth, bodies[i], bodies[i].furthest(-Vec3::UnitZ())));
  }
}

void add_tube_wall(const PackedBed& bed, const std::vector<Body>& bodies, std::vector<Overlap>& overlaps) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Pellet& p = bed.pellets[i];
    if (bodies[i].centre().head<2>().norm() + bodies[i].bounding_radius() <= bed.container.radius) continue;
    const FarPoint far = furthest_from_axis(*bed.shapes[p.shape], p);
    if (far.distance > bed.container.radius)
      overlaps.push_back(with_container(i, far.distance - bed.container.radius, bodies[i], far.point));
  }
}

void add_box_sides(const PackedBed& bed, const std::vector<Body>& bodies, std::vector<Overlap>& overlaps) {
  const Container& box = bed.container;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (const Vec3& along : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())})
      for (const Vec3& out : {along, Vec3(-along)}) {
        const double half = 0.5 * (along.x() > 0 ? box.width : box.depth);
        const Pellet& p = bed.pellets[i];
        const double depth = reach(*bed.shapes[p.shape], p, out) - half;
        if (depth > 0) overlaps.push_back(with_container(i, depth, bodies[i], bodies[i].furthest(out)));
      }
}

/// The deepest point of the pellet in the wall, or of the wall in the pellet.
void add_wall_mesh(const Container& container, const std::vector<Body>& bodies,
                   std::vector<Overlap>& overlaps) {
  const MeshQuery wall(container.surface);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    if (wall.signed_distance(body.centre()) > body.bounding_radius()) continue;
    Overlap deepest = with_container(i, 0, body, body.centre());
    for (const Vec3& own : body.solid().points) {
      const Vec3 p = body.to_world(own);
      if (!wall.inside(p)) continue;
      if (const double d = -wall.signed_distance(p); d > deepest.depth)
        deepest = with_container(i, d, body, p);
    }
    for (const Vec3& v : container.surface.vertices) {
      if ((v - body.centre()).norm() >= body.bounding_radius()) continue;
      if (const double d = body.depth(v); d > deepest.depth) deepest = with_container(i, d, body, v);
    }
    if (deepest.depth > 0) overlaps.push_back(deepest);
  }
}

}  // namespace

double reach_from_axis(const Shape& shape, const Pellet& pellet) {
  return furthest_from_axis(shape, pellet).distance;
}

std::vector<Overlap> container_overlaps(const PackedBed& bed, const std::vector<Body>& bodies) {
  std::vector<Overlap> overlaps;
  switch (bed.container.kind) {
    case ContainerKind::none:
      break;
    case ContainerKind::plane:
      add_floor(bed, bodies, overlaps);
      break;
    case ContainerKind::tube:
      add_floor(bed, bodies, overlaps);
      add_tube_wall(bed, bodies, overlaps);
      break;
    case ContainerKind::box:
      add_floor(bed, bodies, overlaps);
      add_box_sides(bed, bodies, overlaps);
      break;
    case ContainerKind::mesh:
      add_wall_mesh(bed.container, bodies, overlaps);
      break;
  }
  return overlaps;
}

}  // namespace packbed
