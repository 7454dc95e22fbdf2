#pragma once
// Pellets placed by a table: feed.csv of a case, or the poses.csv of another bed.
#include <string>
#include <vector>

#include "bed/scene.hpp"

namespace packbed {

/// Columns by header, in any order: x, y, z with a unit of length (x_mm), vx, vy, vz with one of speed
/// (vx_m/s), wx, wy, wz with one of angular velocity (wx_rad/s), qw, qx, qy, qz, kind or shape (index), fixed
/// (0 or 1), scale (of the shape); id is ignored. Only x, y, z are needed. Lines that start with # are
/// comments. Throws InputError with file and line.
std::vector<PlacedPellet> read_placed_csv(const std::string& path);

}  // namespace packbed
