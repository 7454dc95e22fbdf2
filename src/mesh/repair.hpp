#pragma once
// Repairs that change no geometry: they are safe to do without asking, as long as they are told.
#include <cstddef>
#include <vector>

#include "mesh/mesh.hpp"

namespace packbed {

/// Vertices at bitwise the same place become one; returns how many were dropped. Vertices that no triangle
/// uses go as well, uncounted. All indices must be valid and all coordinates finite.
std::size_t weld(TriangleMesh& mesh);
/// As weld, for vertices within `distance` of each other along each axis (a text file that was written with
/// few digits).
std::size_t weld_within(TriangleMesh& mesh, double distance);

/// A triangle is degenerate when it is flatter than this fraction of the mesh's diagonal.
inline constexpr double kFlatTriangle = 1e-12;
/// Triangles flatter than kFlatTriangle, by index.
std::vector<std::size_t> degenerate_triangles(const TriangleMesh& mesh);
/// Drops triangles that name a vertex twice, and swaps the long side of a triangle whose three corners lie in
/// a line for the other diagonal of it and its neighbour. Returns how many are degenerate still.
std::size_t drop_degenerate(TriangleMesh& mesh);

}  // namespace packbed
