#pragma once
// The surface points of one body in the depth field of another: which of them may come to be deep, which are,
// and what they add to a touch.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/field.hpp"

namespace packbed {

/// The body whose points are asked for, seen from the frame of the field that they are held against.
struct Sight {
  const FieldBody* points = nullptr;
  const DepthField* field = nullptr;
  Mat3 field_turn = Mat3::Identity();  // the field's frame to the world
  Vec3 field_centre = Vec3::Zero();    // [m]
  double field_scale = 1, point_scale = 1;
  std::array<double, 9> turn{};   // points' frame to the field's, both unscaled, row by row
  std::array<double, 3> shift{};  // [m]
  double sign = 1;                // +1: the points are a's, -1: the field is
};
Sight sight(const FieldPellet& points, const DepthField& field, const Pose& field_pose, double field_scale,
            double sign);

/// Points that may come to be deep, filled up with such as never are to whole runs. What it holds changes
/// what a look costs, never what it finds.
struct NearList {
  std::vector<std::uint16_t> index;
  std::vector<float> clear;  // travel of both bodies, from the listing on, up to which each is outside [m]
  void drop() { index.clear(), clear.clear(); }
};
/// Lists the points that may be nearer than `margin` [m] to the field's body, leaving out only such as
/// certainly are not. Returns a lower bound of the distance of those left out [m].
double list_near(const Sight& sight, double margin, NearList& list);

/// Points inside of the field's body, in its frame, those of one cluster together in a run. Runs are padded
/// to a multiple of 4 with points of weight 0.
struct DeepPoints {
  struct Run {
    std::size_t first = 0, last = 0;  // of its points
    std::size_t top = 0;              // the deepest
  };
  std::vector<double> x, y, z, weight, depth, gx, gy, gz;  // [m], gradient of the depth [-]
  std::size_t size = 0;
  std::vector<Run> runs;

  void clear() {
    size = 0;
    runs.clear();
  }
};
/// Sets `deep` to those of the listed points that are inside, now that the bodies have travelled by `travel`
/// [m] since the listing. Those that cannot be are not asked.
void find_deep(const Sight& sight, double travel, NearList& list, DeepPoints& deep);
/// Travel from the listing on up to which all listed points are outside [m].
double clear_of_all(const NearList& list);

/// Adds deep points to a touch whose origin is at `origin` in the world: the runs whose entry in `patch` is
/// `which`, or all when `patch` is empty.
void add_deep(const Sight& sight, const DeepPoints& deep, std::span<const std::uint8_t> patch,
              std::uint8_t which, const Vec3& origin, TouchSum<kPointExponent>& sum);

}  // namespace packbed
