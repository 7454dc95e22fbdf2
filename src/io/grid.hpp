#pragma once
// voxels.h5: a grid as one file. /grid holds the bits as the program has them; /VTKHDF the same as an image
// that ParaView opens, one byte a voxel, its points being the centres of the voxels.
#include <string>

#include "lattice/voxel_grid.hpp"

namespace packbed {

/// What a grid is of, so that it can be analysed without its bed.
struct GridNote {
  double container_radius = 0;  // of the round inside [m]; 0: none, or not known
  double diameter = 0;          // dp of scaled axes [m]; 0: not known
  std::string source;           // where it came from: a bed's hash, a scan
};

struct GridFile {
  VoxelGrid grid;
  GridNote note;
};

/// Whole or not at all. Throws SystemError.
void write_grid(const std::string& path, const VoxelGrid& grid, const GridNote& note);

/// Reads voxels.h5, or the voxels.h5 of a result folder, bit for bit what was written. A missing, cut,
/// changed or foreign file is an InputError.
GridFile read_grid(const std::string& path_or_folder);

/// True when a file ends with the seal of a grid; false for any other and for none.
bool is_grid_file(const std::string& path);
/// The same, and for a result folder that has a grid and no bed.
bool holds_grid(const std::string& path_or_folder);

}  // namespace packbed
