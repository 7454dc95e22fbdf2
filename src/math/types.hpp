#pragma once
// The few linear-algebra types that every floor speaks. Lengths are metres, masses kilograms, times seconds.
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cstdint>

namespace packbed {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;  // printed and stored as (w, x, y, z)
using Box3 = Eigen::AlignedBox3d;

inline constexpr double kPi = 3.14159265358979323846;

/// Where a body is: centre of mass [m] and rotation from the shape's own frame to the world.
struct Pose {
  Vec3 position = Vec3::Zero();
  Quat rotation = Quat::Identity();

  Vec3 to_world(const Vec3& local) const { return position + rotation * local; }
  Vec3 to_local(const Vec3& world) const { return rotation.conjugate() * (world - position); }
};

}  // namespace packbed
