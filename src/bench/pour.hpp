#pragma once
// Beds that benches pour, and what they ask of them.
#include <string>
#include <vector>

#include "bed/packed_bed.hpp"
#include "bed/scene.hpp"
#include "bench/bench.hpp"
#include "bench/statistics.hpp"

namespace packbed::bench {

/// Plain numbers, so that they can be averaged.
struct PouredBed {
  double density = 0;                            // of the middle section, exact [-]
  double mean_height_mm = 0;                     // of the centres of mass
  double rest_mean = 0, rest_max = 0, peak = 0;  // overlaps [% of the thickness]
  double ledger = 0;                             // error of the energy books [%]
  double cpu_s = 0, setup_s = 0, steps = 0;
  double pellets = 0;
  bool audit = false;
  std::vector<double>
      radial;  // density over the distance from the wall, exact; empty in containers not round
  std::string hash;
};

/// The case of the options, with their number of pellets; `sets`: key=value, as on the command line.
Scene poured_scene(const Options& options, std::uint64_t seed, const std::vector<std::string>& sets = {});
/// Packs it and measures the bed without voxels.
PouredBed pour(const Scene& scene);

Mean over_seeds(const std::vector<PouredBed>& beds, double PouredBed::*value);

double mean_height(const PackedBed& bed);  ///< of the centres of mass [m]

}  // namespace packbed::bench
