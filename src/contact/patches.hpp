#pragma once
// Contact of two bodies of any shape, patch by patch. Where two bodies touch in several places, or round a
// corner, each place has its own normal, spring and dashpot: summed up, opposing normals would cancel, and
// friction with them.
//
// The energy is that of the pair (contact/field.hpp), so it is smooth whatever belongs to which patch:
//
//   delta^8 = sum over patches of delta_p^8,   W = k delta^2 / 2 = sum over patches of k_p delta_p^2 / 2
//   k_p = k (delta_p / delta)^6                (Touch::share)
//
// and the force of each patch, k_p delta_p (-d delta_p / dq), is its share of the exact gradient of W.
//
// Points belong together when they lie side by side, or within the size of the bodies and with normals within
// kCone of one another; a patch that was there at the last look keeps the points that are nearest to it.
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "contact/deep_points.hpp"

namespace packbed {

inline constexpr std::size_t kMostPatches = 4;
/// Cosine of the angle between normals beyond which they are not of one patch, and within which two patches
/// are one: 45 and 25 degrees, apart so that nothing goes back and forth.
inline constexpr double kCone = 0.7, kJoin = 0.9;

/// Points so near to one another are of one patch whatever their normals, as where two edges cross; fraction
/// of the size of the bodies.
inline constexpr double kSideBySide = 0.12;

/// Where a patch was at the last look.
struct PatchMark {
  Vec3 centre = Vec3::Zero();  // of pressure [m]
  Vec3 normal = Vec3::Zero();  // of the force on a, unit
};

/// The points of a pair that may be deep, kept while the bodies hardly move.
struct NearPoints {
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  std::array<NearList, 2> of;  // a's points, b's points
  std::uint32_t looks = 0;     // that these lists have served
  double listed = 0;           // travel of both bodies when they were made [m]
  double until = kNever;       // ... at which they are made again [m]
  double margin = 0;           // with which they were made [m]
};

struct PatchTouches {
  std::array<Touch, kMostPatches> touch;
  std::array<std::uint8_t, kMostPatches>
      mark{};  // each goes on from that of the given marks; kMostPatches: new
  std::size_t count = 0;
  double delta = 0, depth = 0;  // of the pair [m]; 0: apart
  double gap = 0;               // apart: the bodies may travel so far in all before they can touch [m]
};

/// `travelled`: travel of both bodies so far [m]; marks: those of the last look, at most kMostPatches.
void touch_patches(const FieldPellet& a, const FieldPellet& b, double travelled,
                   std::span<const PatchMark> marks, NearPoints& near, PatchTouches& out);
/// With a container, which is b.
void touch_patches(const FieldPellet& a, const FieldWall& wall, double travelled,
                   std::span<const PatchMark> marks, NearPoints& near, PatchTouches& out);

}  // namespace packbed
