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

/// Most spheres that are drawn as surfaces: a million triangles or so.
inline constexpr std::size_t kMostDrawnSpheres = 5000;

/// Every pellet as its surface; recognised cylinders as caps and quadrilaterals. A bed of more spheres than
/// kMostDrawnSpheres has one point each instead. Cell data: pellet, shape, height_m, angle_deg, overlap (0
/// when not known). Point data of such spheres: diameter_m. Throws SystemError.
void write_vtu(const std::string& path, const PackedBed& bed, const CellFields& fields = {});

/// The same for a frame of a run.
void write_vtu(const std::string& path, const std::vector<ShapePtr>& shapes,
               const std::vector<Pellet>& pellets, const CellFields& fields = {});

/// Every pellet as one point with glyph data: pellet, shape, scale, rotation_wxyz, velocity_m_s, spin_rad_s.
void write_point_vtu(const std::string& path, const std::vector<Pellet>& pellets);

/// The container as read, or the inside of a tube that is given by its sizes; without cells when there is
/// nothing to draw (a plane, no container).
void write_container_vtu(const std::string& path, const Container& container);

/// Angle between the pellet's own z axis and the vertical, 0 to 90 degrees.
double angle_to_vertical_deg(const Pellet& pellet);

}  // namespace packbed
