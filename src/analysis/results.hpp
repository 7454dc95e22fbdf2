#pragma once
// What the analysis of a bed or a grid tells: plain records. Densities are solid volume over space volume.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "math/types.hpp"

namespace packbed {

/// A curve over a distance; x in pellet diameters dp and in metres, one value a bin (n each).
struct Profile {
  std::vector<double>
      x_m;  // bin centres: height above the floor (axial) or distance from the wall (radial) [m]
  std::vector<double> x_dp;     // the same in pellet diameters
  std::vector<double> density;  // from voxels; empty when there is no grid
  std::vector<double>
      exact;  // voxel-free, same bins; empty when not asked for or not defined for these shapes
};

struct PlanarMap {
  std::array<int, 2> size{0, 0};  // cells along x, y
  double pitch = 0;               // [m]
  Vec3 origin = Vec3::Zero();     // lower corner of cell (0, 0) [m]
  std::vector<float> density;     // column averages over z_range (ny, nx); NaN outside the container
};

struct Orientation {
  std::vector<double> from_deg, to_deg;  // classes of the angle between pellet axis and container axis (9)
  std::vector<int> count;
  std::vector<double> fraction;   // of the pellets counted
  std::vector<double> isotropic;  // what uniformly random axes would give
  std::vector<double> angle_deg;  // one a pellet, NaN where the pellet has no axis
  std::vector<std::array<double, 2>>
      lambert;  // equal-area lower-hemisphere projection, unit disc, one a pellet with an axis
};

struct BulkDensity {
  double packing_density =
      0;                // mean of the axial profile over the middle section, from voxels (NaN without a grid)
  double exact = 0;     // the same without voxels (NaN where not defined)
  double axial_sd = 0;  // standard deviation of the axial profile within the section: within this bed
  std::array<double, 2> z_range_m{0, 0};
  double voxel_m = 0;
  double diameter_m = 0;   // dp
  std::string definition;  // one sentence: which volume over which space, region, voxel size
};

struct OverlapAudit {
  double mean = 0, max = 0;    // depth over all touching pairs, fraction of the smallest thickness
  int pairs = 0;               // that overlap by more than 1e-9 of it
  std::vector<double> pellet;  // deepest overlap of each pellet, same unit (n)
  double volume = 0;           // sum of pair intersection volumes [m3], estimated
};

struct AnalysisResult {
  double bed_height_m = 0;
  BulkDensity bulk;
  Profile axial, radial;
  std::optional<PlanarMap> planar;
  std::optional<Orientation> orientation;
  std::optional<OverlapAudit> overlap;
  double voxelise_cpu_s = 0, analyse_cpu_s = 0;
};

}  // namespace packbed
