#include "packers/entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "contact/field.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

/// The point of a convex body, or vertex of a mesh, farthest along `direction` (world), in world axes.
Vec3 support(const Shape& shape, double scale, const Pose& pose, const Vec3& direction) {
  const Vec3 d = pose.rotation.conjugate() * direction;
  Vec3 local = Vec3::Zero();
  if (shape.kind == ShapeClass::sphere) {
    local = d.normalized() * shape.radius;
  } else if (shape.kind == ShapeClass::cylinder) {
    const double across = std::hypot(d.x(), d.y());
    const double r = across > 0 ? shape.radius / across : 0;
    local = Vec3(r * d.x(), r * d.y(), std::copysign(shape.half_height, d.z()));
  } else {
    double best = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : shape.surface.vertices)
      if (v.dot(d) > best) best = v.dot(d), local = v;
  }
  return pose.position + pose.rotation * (local * scale);
}

std::string micrometres(double length) {
  return fmt::format("{:.4g} um", length * 1e6);
}

/// Depths of pairs that are not both convex, by the general kernel; its fields are made when first asked for.
class Fields {
 public:
  Fields(const Scene& scene, const OverlapTest& test)
      : scene_(scene), test_(test), body_(scene.pellets.size()) {}
  double depth(const Pellet& a, const Pellet& b) {
    const double reach = test_.bounding_radius(a) + test_.bounding_radius(b);
    if ((a.pose.position - b.pose.position).squaredNorm() >= reach * reach) return 0;
    return touch_field({&body(a.shape), a.pose, a.scale}, {&body(b.shape), b.pose, b.scale}).depth;
  }

 private:
  const FieldBody& body(std::uint32_t kind) {
    if (!body_[kind])
      body_[kind] = std::make_unique<const FieldBody>(make_field_body(*scene_.pellets[kind].shape));
    return *body_[kind];
  }
  const Scene& scene_;
  const OverlapTest& test_;
  std::vector<std::unique_ptr<const FieldBody>> body_;
};

void check_pose(const Pellet& p) {
  const bool finite = p.pose.position.allFinite() && p.pose.rotation.coeffs().allFinite() &&
                      p.velocity.allFinite() && p.spin.allFinite();
  if (!finite || std::abs(p.pose.rotation.norm() - 1) > 1e-6)
    throw InputError(fmt::format("placed pellet {}", p.id),
                     "a pose or velocity that is not a number, or a rotation that is none",
                     "finite numbers and a quaternion (w, x, y, z) of length 1");
}

}  // namespace

double radial_extent(const Shape& shape, double scale, const Pose& pose) {
  const auto radius_of = [](const Vec3& x) { return std::hypot(x.x(), x.y()); };
  if (seen_as_mesh(shape.kind)) {
    double extent = 0;
    for (const Vec3& v : shape.surface.vertices)
      extent = std::max(extent, radius_of(pose.to_world(v * scale)));
    return extent;
  }
  // The radius is a convex function: going to the body's farthest point along the present radius never
  // lowers it. Eight starts find all of the at most four local maxima of two rims.
  double extent = 0;
  for (int start = 0; start < 8; ++start) {
    const double angle = kPi / 4 * start;
    Vec3 direction(std::cos(angle), std::sin(angle), 0);
    for (int turn = 0; turn < 100; ++turn) {
      const Vec3 x = support(shape, scale, pose, direction);
      const double r = radius_of(x);
      if (!(r > extent) && turn > 20) break;
      extent = std::max(extent, r);
      direction = Vec3(x.x(), x.y(), 0);
      if (!(r > 0)) break;
    }
  }
  return extent;
}

double lowest_point(const Shape& shape, double scale, const Pose& pose) {
  return support(shape, scale, pose, Vec3(0, 0, -1)).z();
}

Room::Room(const Container& container)
    : kind_(container.kind),
      radius_(container.radius),
      half_width_(0.5 * container.width),
      half_depth_(0.5 * container.depth) {
  if (kind_ == ContainerKind::mesh) wall_ = std::make_unique<const TriangleTree>(container.surface);
}
Room::~Room() = default;

bool Room::holds_sphere(const Vec3& centre, double radius) const {
  constexpr double kRounding = 1e-9;  // of the size
  switch (kind_) {
    case ContainerKind::none:
      return true;
    case ContainerKind::plane:
      return centre.z() >= radius;
    case ContainerKind::tube:
      return centre.z() >= radius && std::hypot(centre.x(), centre.y()) + radius <= radius_ * (1 + kRounding);
    case ContainerKind::box:
      return centre.z() >= radius && std::abs(centre.x()) + radius <= half_width_ * (1 + kRounding) &&
             std::abs(centre.y()) + radius <= half_depth_ * (1 + kRounding);
    case ContainerKind::mesh:
      return wall_->signed_distance(centre) >= radius * (1 - kRounding);
  }
  return false;
}

double Room::overlap(const Shape& shape, double scale, const Pose& pose) const {
  double overlap = 0;
  if (kind_ == ContainerKind::plane || kind_ == ContainerKind::tube || kind_ == ContainerKind::box)
    overlap = -lowest_point(shape, scale, pose);
  if (kind_ == ContainerKind::box)
    for (const double sign : {-1.0, 1.0}) {
      const auto beyond = [&](const Vec3& out) { return out.dot(support(shape, scale, pose, out)); };
      overlap = std::max(
          {overlap, beyond(sign * Vec3::UnitX()) - half_width_, beyond(sign * Vec3::UnitY()) - half_depth_});
    }
  if (kind_ == ContainerKind::tube) overlap = std::max(overlap, radial_extent(shape, scale, pose) - radius_);
  if (kind_ == ContainerKind::mesh) {
    const double centre = wall_->signed_distance(pose.position);
    overlap = shape.kind == ShapeClass::sphere ? shape.radius * scale - centre : -centre;
    if (shape.kind != ShapeClass::sphere && centre < shape.bounding_radius * scale)
      for (const Vec3& v : shape.surface.vertices)
        overlap = std::max(overlap, -wall_->signed_distance(pose.to_world(v * scale)));
  }
  return std::max(0.0, overlap);
}

void check_placed(const Scene& scene, const OverlapTest& test, const Room& room,
                  std::span<const Pellet> pellets) {
  const double allowed = std::max(scene.pellet_contact.allowed_overlap, scene.overlap_limit);
  const double allowed_wall = std::max(scene.wall_contact.allowed_overlap, scene.overlap_limit);
  const auto thickness = [&](const Pellet& p) {
    return scene.pellets[p.shape].shape->smallest_thickness * p.scale;
  };
  for (const Pellet& p : pellets) {
    check_pose(p);
    const double overlap = room.overlap(*scene.pellets[p.shape].shape, p.scale, p.pose);
    if (!p.fixed && overlap > allowed_wall * thickness(p))
      throw InputError(fmt::format("placed pellet {}", p.id),
                       fmt::format("{} outside of the container", micrometres(overlap)),
                       fmt::format("at most {}", micrometres(allowed_wall * thickness(p))),
                       "move it inwards, or make it fixed");
  }
  Fields fields(scene, test);
  // pairs whose height ranges meet, from the lowest upwards
  std::vector<std::size_t> order(pellets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto low = [&](std::size_t i) {
    return pellets[i].pose.position.z() - test.bounding_radius(pellets[i]);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Pellet& a = pellets[order[i]];
    const double top = a.pose.position.z() + test.bounding_radius(a);
    for (std::size_t j = i + 1; j < order.size() && low(order[j]) < top; ++j) {
      const Pellet& b = pellets[order[j]];
      if (a.fixed && b.fixed) continue;
      const double limit = allowed * std::min(thickness(a), thickness(b));
      const double overlap =
          test.exact(a.shape) && test.exact(b.shape) ? test.depth(a, b) : fields.depth(a, b);
      if (overlap > limit)
        throw InputError(fmt::format("placed pellets {} and {}", std::min(a.id, b.id), std::max(a.id, b.id)),
                         fmt::format("an overlap of {}", micrometres(overlap)),
                         fmt::format("at most {}", micrometres(limit)),
                         "move one of them, or make both fixed");
    }
  }
}

}  // namespace packbed
