// The lattice packers: what the voxel does to a bed, over seeds, with cost; the mesh packer's bed beside.
#include <fmt/format.h>

#include <cmath>

#include "bench/bench.hpp"
#include "bench/pour.hpp"
#include "bench/statistics.hpp"

namespace packbed::bench {
namespace {

struct Beds {
  double pitch = 0;  // of the lattice [m]; 0: no lattice
  std::vector<PouredBed> beds;

  Mean mean(double PouredBed::*value) const { return over_seeds(beds, value); }
  double cpu_s() const { return mean(&PouredBed::cpu_s).value; }

  /// Mean of all seeds, bin by bin. A bin that any of them has nothing in is NaN.
  std::vector<double> radial() const {
    std::vector<double> out(beds.front().radial.size(), 0);
    for (const PouredBed& b : beds)
      for (std::size_t k = 0; k < out.size() && k < b.radial.size(); ++k)
        out[k] += b.radial[k] / static_cast<double>(beds.size());
    return out;
  }
  /// What the mean profile of so many seeds scatters by, rms over its bins.
  double radial_error() const {
    std::vector<double> errors;
    for (std::size_t k = 0; k < beds.front().radial.size(); ++k) {
      std::vector<double> values;
      for (const PouredBed& b : beds)
        if (k < b.radial.size()) values.push_back(b.radial[k]);
      const double error = mean_of(values).error;
      if (std::isfinite(error)) errors.push_back(error);
    }
    return errors.empty() ? std::numeric_limits<double>::quiet_NaN() : root_mean_square(errors);
  }
};

double rms_distance(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> off;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    if (std::isfinite(a[k] - b[k])) off.push_back(a[k] - b[k]);
  return off.empty() ? std::numeric_limits<double>::quiet_NaN() : root_mean_square(off);
}

/// The case by one method on voxels `coarser` times as large as its own; 0: without a lattice.
Beds pour_seeds(const Options& options, const std::string& method, double coarser, int seeds) {
  Beds out;
  for (int seed = 1; seed <= seeds; ++seed) {
    Scene scene = poured_scene(options, static_cast<std::uint64_t>(seed), {"method=\"" + method + "\""});
    if (coarser > 0) {
      LatticeRules& rules = scene.lattice;
      out.pitch = rules.voxel = coarser * (rules.voxel > 0 ? rules.voxel : scene.analysis.voxel);
      if (rules.interval > 0)  // a step is one cell: the same way to fall between two layers
        rules.interval = static_cast<int>(std::lround(rules.interval / coarser));
    }
    options.tell(coarser > 0 ? fmt::format("lattice: {}, {:.3g} mm, seed {}", method, 1e3 * out.pitch, seed)
                             : fmt::format("lattice: {}, seed {}", method, seed));
    out.beds.push_back(pour(scene));
  }
  return out;
}

void add_row(Table& table, const std::string& method, const Beds& row, const Beds& finest) {
  const Mean density = row.mean(&PouredBed::density);
  const std::vector<double> radial = row.radial();
  const bool itself = &row == &finest;
  const double none = std::numeric_limits<double>::quiet_NaN();
  int passed = 0;
  for (const PouredBed& b : row.beds) passed += b.audit;
  table.add(method, row.pitch > 0 ? 1e3 * row.pitch : none, row.beds.size(), density.value, density.error,
            itself ? none : density.value - finest.mean(&PouredBed::density).value,
            itself ? none : rms_distance(radial, finest.radial()), row.radial_error(),
            row.mean(&PouredBed::rest_mean).value, row.mean(&PouredBed::steps).value, row.cpu_s(), passed,
            row.beds.front().hash);
}

}  // namespace

Outcome bench_lattice(const Options& options) {
  Outcome out;
  out.table.columns = {"method",
                       "voxel [mm]",
                       "seeds",
                       "packing density",
                       "standard error",
                       "density, less the finest's",
                       "radial profile, rms distance to the finest's",
                       "standard error of a profile, rms",
                       "overlap of the bodies, mean [% of thickness]",
                       "steps",
                       "CPU [s]",
                       "audits passed",
                       "bed of the first seed"};
  Picture density{"lattice_density",
                  "Packing density against the voxel",
                  {"CPU time of a bed [s]", true},
                  {"packing density", false},
                  {}};
  Picture radial{"lattice_radial",
                 "Radial profile against that of the finest voxel",
                 {"CPU time of a bed [s]", true},
                 {"rms distance", true},
                 {}};
  const int seeds = options.seeds > 0 ? options.seeds : options.quick ? 2 : 3;
  const std::vector<double> coarser =
      options.quick ? std::vector{1.5, 3.0} : std::vector{2.0 / 3, 1.0, 1.5, 2.0, 3.0};  // the finest first
  for (const std::string method : {"digipac", "digicgp", "digidem", "mesh"}) {
    std::vector<Beds> rows;
    for (const double c : method == "mesh" ? std::vector{0.0} : coarser)
      rows.push_back(pour_seeds(options, method, c, seeds));
    Series of_density{method, {}, {}, {}, {}}, of_radial = of_density;
    for (const Beds& row : rows) {
      add_row(out.table, method, row, rows.front());
      const std::string label = row.pitch > 0 ? fmt::format("{:.3g} mm", 1e3 * row.pitch) : "";
      const Mean mean = row.mean(&PouredBed::density);
      of_density.x.push_back(row.cpu_s());
      of_density.y.push_back(mean.value);
      of_density.error.push_back(mean.error);
      of_density.label.push_back(label);
      if (&row == &rows.front()) continue;
      of_radial.x.push_back(row.cpu_s());
      of_radial.y.push_back(rms_distance(row.radial(), rows.front().radial()));
      of_radial.label.push_back(label);
      out.findings.push_back(
          fmt::format("{} at {:.3g} mm: density {:+.4f} against {:.3g} mm, radial profile within {:.3f} "
                      "(rms), {:.2g} times its CPU",
                      method, 1e3 * row.pitch, mean.value - rows.front().mean(&PouredBed::density).value,
                      1e3 * rows.front().pitch, of_radial.y.back(), row.cpu_s() / rows.front().cpu_s()));
    }
    density.series.push_back(of_density);
    if (!of_radial.x.empty()) radial.series.push_back(of_radial);
  }
  out.pictures = {density, radial};
  return out;
}

}  // namespace packbed::bench
