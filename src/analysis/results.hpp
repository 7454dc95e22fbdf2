#pragma once
// What the analysis of a bed or a grid tells: plain records. Densities are solid volume over space volume.
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "math/types.hpp"

namespace packbed {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

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

/// Voids between the pellets of the core: what lies so far from all side walls, the floor and the top of the
/// bed that none of them is felt. NaN where a number does not exist.
struct CorePorosity {
  double margin_m = 0;                    // from everything
  std::array<double, 2> z_range_m{0, 0};  // of the core; empty when the bed is too small to have one
  double volume_m3 = 0;                   // 0: there is no core
  double exact = kNone;                   // spheres in a box or tube, without voxels
  double voxels = kNone;                  // from the grid
  double shots = kNone;                   // mean over the test cells
  double shots_error = kNone;             // standard error of `shots`, from the number of points
  std::int64_t cells = 0;                 // test cells, and points in each
  int shots_per_cell = 0;
  double cell_m = 0;
  double cell_sd = kNone;  // standard deviation of the porosity over the cells
  std::string definition;  // one sentence
  /// The best there is: exact, else from voxels, else from shots.
  double best() const;
};

/// Correlation of size and place along x, y and z (Dziugys et al. 2022, equation 2): +1 when all larger
/// pellets are farther that way, -1 when all smaller ones are. Up is z: positive when large ones lie above.
struct Segregation {
  std::array<double, 3> along{kNone, kNone, kNone};  // NaN when all are alike
};

/// Pellets of about one size.
struct SizeRow {
  std::uint32_t shape = 0;
  double from_m = 0, to_m = 0;  // diameter of the sphere of the same volume; equal for a single size
  double diameter_m = 0;        // mean
  int count = 0;
  double number = 0, volume = 0;                      // shares of the shape's pellets
  double asked_number = kNone, asked_volume = kNone;  // what the case asks for; NaN where nobody knows
};

/// Touching pellets.
struct Coordination {
  double mean = 0;              // touching pellets of a pellet
  double core = kNone;          // the same over pellets whose centre is in the core; NaN without one
  double core_bearing = kNone;  // ... without the rattlers
  int rattlers = 0;             // pellets with fewer than four contacts, the container's counted
  std::vector<int> histogram;   // pellets with 0, 1, ... touching pellets
  std::vector<double> by_size;  // mean of the pellets of each row of AnalysisResult::sizes
  std::string source;           // "forces of the packer" or "overlaps"
};

struct AnalysisResult {
  double bed_height_m = 0;
  BulkDensity bulk;
  Profile axial, radial;
  std::optional<PlanarMap> planar;
  std::optional<Orientation> orientation;
  std::optional<OverlapAudit> overlap;
  double smallest_m = 0, largest_m = 0;  // of the pellets: diameter of the sphere of the same volume
  std::vector<SizeRow> sizes;            // empty when all pellets are alike
  std::optional<CorePorosity> core;
  std::optional<Segregation> segregation;
  std::optional<Coordination> coordination;
  double voxelise_cpu_s = 0, analyse_cpu_s = 0;
};

}  // namespace packbed
