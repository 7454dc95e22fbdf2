#include <algorithm>
#include <array>

#include "bench/bench.hpp"
#include "math/error.hpp"

namespace packbed::bench {
namespace {

constexpr std::array kBenches = {
    Bench{"contact", "How close are forces to the converged law, at what cost?", bench_contact},
    Bench{"integrator", "How do energy and angle depend on the step?", bench_integrator},
    Bench{"voxels", "How do volumes and profiles depend on the voxel?", bench_voxels},
    Bench{"bed", "What do step, stiffness, sleep and kernel do to a bed?", bench_bed},
    Bench{"lattice", "What does the voxel do to a bed of a lattice packer?", bench_lattice},
    Bench{"scaling", "How does the cost grow with pellets and threads?", bench_scaling},
    Bench{"skipping", "What does a part cost that a scene does not need?", bench_skipping},
    Bench{"stability", "Does it hold where others break?", bench_stability},
};

}  // namespace

std::span<const Bench> benches() {
  return kBenches;
}

const Bench& find_bench(std::string_view name) {
  const auto found =
      std::find_if(kBenches.begin(), kBenches.end(), [&](const Bench& b) { return b.name == name; });
  if (found != kBenches.end()) return *found;
  std::string names;
  for (const Bench& b : kBenches) names += (names.empty() ? "" : ", ") + std::string(b.name);
  throw InputError("packbed bench", '"' + std::string(name) + '"', names, "packbed bench --list tells them");
}

}  // namespace packbed::bench
