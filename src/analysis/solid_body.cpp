#include "analysis/solid_body.hpp"

#include <algorithm>
#include <cmath>

namespace packbed {
namespace {

constexpr double kApart = 1, kNone = 0;  // an empty chord: from 1 to 0

/// Corners, middles of sides and of triangles: where bodies of flat faces dip into each other first.
std::vector<Vec3> surface_points(const TriangleMesh& mesh) {
  std::vector<Vec3> points = mesh.vertices;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(t[0])],
               &b = mesh.vertices[static_cast<std::size_t>(t[1])],
               &c = mesh.vertices[static_cast<std::size_t>(t[2])];
    points.push_back((a + b + c) / 3);
    if (t[0] < t[1]) points.push_back((a + b) / 2);  // a side belongs to two triangles
    if (t[1] < t[2]) points.push_back((b + c) / 2);
    if (t[2] < t[0]) points.push_back((c + a) / 2);
  }
  return points;
}

/// Points on the exact surface of a tube: close together on the four rims, which dip in first.
std::vector<Vec3> tube_points(const Shape& tube) {
  constexpr int kRim = 240, kRows = 12, kRound = 72, kRings = 5;
  std::vector<Vec3> points;
  const auto add = [&](double radius, double z, int count) {
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * kPi * i / count;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  };
  for (const double radius : {tube.inner_radius, tube.radius}) {
    for (const double side : {-1.0, 1.0}) add(radius, side * tube.half_height, kRim);
    for (int k = 1; k < kRows; ++k) add(radius, tube.half_height * (2.0 * k / kRows - 1), kRound);
  }
  for (int k = 1; k < kRings; ++k)
    for (const double side : {-1.0, 1.0})
      add(tube.inner_radius + (tube.radius - tube.inner_radius) * k / kRings, side * tube.half_height,
          kRound);
  return points;
}

/// Narrows [from, to] to where slope t <= room.
bool clip(std::pair<double, double>& part, double slope, double room) {
  if (slope > 0)
    part.second = std::min(part.second, room / slope);
  else if (slope < 0)
    part.first = std::max(part.first, room / slope);
  else
    return room >= 0;
  return part.first < part.second;
}

}  // namespace

std::pair<double, double> sphere_chord(double radius, const Vec3& o, const Vec3& d) {
  const double b = o.dot(d), rest = b * b - o.squaredNorm() + radius * radius;
  if (rest <= 0) return {kApart, kNone};
  const double root = std::sqrt(rest);
  return {-b - root, -b + root};
}

std::pair<double, double> cylinder_chord(double radius, double half_height, const Vec3& o, const Vec3& d) {
  const double across = d.head<2>().squaredNorm(), outside = o.head<2>().squaredNorm() - radius * radius;
  std::pair<double, double> part{-1e300, 1e300};
  if (across < 1e-24) {
    if (outside >= 0) return {kApart, kNone};
  } else {
    const double b = o.head<2>().dot(d.head<2>()), rest = b * b - across * outside;
    if (rest <= 0) return {kApart, kNone};
    const double root = std::sqrt(rest);
    part = {(-b - root) / across, (-b + root) / across};
  }
  if (!clip(part, d.z(), half_height - o.z()) || !clip(part, -d.z(), half_height + o.z()))
    return {kApart, kNone};
  return part;
}

SolidShape::SolidShape(ShapePtr s) : shape(std::move(s)) {
  if (shape->kind == ShapeClass::tube) {
    convex = false;
    points = tube_points(*shape);
    return;
  }
  points = surface_points(shape->surface);
  if (!seen_as_mesh(shape->kind)) return;
  planes = convex_planes(shape->surface);
  convex = !planes.empty();
  if (!convex) query = std::make_unique<MeshQuery>(shape->surface);
}

Body::Body(const SolidShape& solid, const Pellet& pellet)
    : solid_(&solid),
      scale_(pellet.scale),
      centre_(pellet.pose.position),
      rotation_(pellet.pose.rotation.toRotationMatrix()) {}

Vec3 Body::furthest(const Vec3& direction) const {
  const Shape& shape = *solid_->shape;
  const Vec3 n = rotation_.transpose() * direction;
  Vec3 own = Vec3::Zero();
  if (shape.kind == ShapeClass::sphere) {
    own = shape.radius * n.normalized();
  } else if (shape.kind == ShapeClass::cylinder || shape.kind == ShapeClass::tube) {
    const double across = n.head<2>().norm(), side = across > 1e-15 * n.norm() ? shape.radius / across : 0;
    own = {side * n.x(), side * n.y(), std::copysign(shape.half_height, n.z())};
  } else {
    double best = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : shape.surface.vertices)
      if (const double d = n.dot(v); d > best) {
        best = d;
        own = v;
      }
  }
  return to_world(own);
}

std::pair<double, double> Body::chord(const Vec3& origin, const Vec3& direction) const {
  const Shape& shape = *solid_->shape;
  const Vec3 o = rotation_.transpose() * (origin - centre_), d = rotation_.transpose() * direction;
  if (shape.kind == ShapeClass::sphere) return sphere_chord(scale_ * shape.radius, o, d);
  if (shape.kind == ShapeClass::cylinder)
    return cylinder_chord(scale_ * shape.radius, scale_ * shape.half_height, o, d);
  std::pair<double, double> part{-1e300, 1e300};
  for (const auto& [n, offset] : solid_->planes)
    if (!clip(part, n.dot(d), scale_ * offset - n.dot(o))) return {kApart, kNone};
  return part;
}

double Body::depth(const Vec3& point) const {
  const Shape& shape = *solid_->shape;
  const Vec3 own = rotation_.transpose() * (point - centre_) / scale_;
  if (shape.kind == ShapeClass::sphere) return scale_ * (shape.radius - own.norm());
  if (shape.kind == ShapeClass::cylinder)
    return scale_ * std::min(shape.radius - own.head<2>().norm(), shape.half_height - std::abs(own.z()));
  if (shape.kind == ShapeClass::tube) {
    const double rho = own.head<2>().norm();
    return scale_ *
           std::min({shape.radius - rho, rho - shape.inner_radius, shape.half_height - std::abs(own.z())});
  }
  if (!solid_->convex) return solid_->query->inside(own) ? -scale_ * solid_->query->signed_distance(own) : 0;
  double room = std::numeric_limits<double>::infinity();
  for (const auto& [n, offset] : solid_->planes) room = std::min(room, offset - n.dot(own));
  return scale_ * room;
}

}  // namespace packbed
