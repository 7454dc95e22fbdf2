#pragma once
// What `packbed bench` can ask: one function a bench, each with its numbers and a picture of them
// (docs/benchmarks.md).
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/picture.hpp"
#include "bench/table.hpp"

namespace packbed::bench {

struct Options {
  bool quick = false;                            // a size that ends in seconds instead of hours
  std::string case_file = "cases/quick.toml";    // of the benches that pour whole beds
  int pellets = 0;                               // of those beds; 0: as the case says, 60 when quick
  int seeds = 0;                                 // 0: as the bench likes
  std::function<void(const std::string&)> told;  // progress, a line at a time; may be empty

  void tell(const std::string& line) const {
    if (told) told(line);
  }
};

struct Outcome {
  Table table;
  std::vector<Picture> pictures;
  std::vector<std::string> findings;  // sentences that the numbers say
  bool passed = true;                 // false: a threshold is broken
};

struct Bench {
  std::string_view name, asks;
  Outcome (*run)(const Options&);
};

/// In the order in which they run.
std::span<const Bench> benches();
/// Throws InputError that lists the names.
const Bench& find_bench(std::string_view name);

Outcome bench_contact(const Options& options);
Outcome bench_integrator(const Options& options);
Outcome bench_voxels(const Options& options);
Outcome bench_bed(const Options& options);
Outcome bench_lattice(const Options& options);
Outcome bench_scaling(const Options& options);
Outcome bench_skipping(const Options& options);
Outcome bench_stability(const Options& options);

}  // namespace packbed::bench
