#pragma once
// Beds for ParaView and VTK: .vtu files (XML UnstructuredGrid, zlib-compressed appended data).
#include <string>
#include <vector>

#include "bed/packed_bed.hpp"

namespace packbed {

/// What a cell of a pellet carries beside pellet id, shape, height [m] and angle to the vertical [degree].
struct CellFields {
  std::vector<double>
      overlap;  // deepest overlap of each pellet, fraction of its smallest thickness (n or empty)
};

/// Every pellet as its surface; recognised cylinders as caps and quadrilaterals. Cell data: pellet, shape,
/// height_m, angle_deg, overlap (0 when not known). Throws SystemError.
void write_vtu(const std::string& path, const PackedBed& bed, const CellFields& fields = {});

/// Every pellet as one point with glyph data: quaternion (w, x, y, z), velocity, spin, scale, shape.
void write_point_vtu(const std::string& path, const std::vector<Pellet>& pellets);

/// Angle between the pellet's own z axis and the vertical, 0 to 90 degrees.
double angle_to_vertical_deg(const Pellet& pellet);

}  // namespace packbed
