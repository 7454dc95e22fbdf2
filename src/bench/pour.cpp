#include "bench/pour.hpp"

#include "analysis/analyse.hpp"
#include "io/case.hpp"
#include "packers/packer.hpp"

namespace packbed::bench {

Scene poured_scene(const Options& options, std::uint64_t seed, const std::vector<std::string>& given) {
  std::vector<std::string> sets{"output.checkpoint_interval=\"0 s\""};
  sets.insert(sets.end(), given.begin(), given.end());
  const int pellets = options.pellets > 0 ? options.pellets : options.quick ? 60 : 0;
  if (pellets > 0) sets.push_back("feed.count=" + std::to_string(pellets));
  return read_case(options.case_file, sets, seed);
}

double mean_height(const PackedBed& bed) {
  double sum = 0;
  for (const Pellet& p : bed.pellets) sum += p.pose.position.z();
  return bed.pellets.empty() ? 0 : sum / static_cast<double>(bed.pellets.size());
}

Mean over_seeds(const std::vector<PouredBed>& beds, double PouredBed::*value) {
  std::vector<double> values;
  for (const PouredBed& b : beds) values.push_back(b.*value);
  return mean_of(values);
}

PouredBed pour(const Scene& scene) {
  const PackResult result = pack(scene, {});
  AnalysisWish wish = scene.analysis;
  wish.voxels = wish.orientation = false;
  const AnalysisResult analysis = analyse_bed(result.bed, wish);
  const RunRecord& record = result.record;
  PouredBed out;
  out.density = analysis.bulk.exact;
  out.mean_height_mm = 1e3 * mean_height(result.bed);
  out.rest_mean = 100 * analysis.overlap->mean;
  out.rest_max = 100 * analysis.overlap->max;
  out.peak = 100 * record.overlap.peak;
  out.ledger = 100 * record.energy.ledger_error;
  out.cpu_s = record.time.cpu_s;
  out.setup_s = record.time.setup_s;
  out.steps = static_cast<double>(record.time.steps);
  out.pellets = static_cast<double>(result.bed.pellets.size());
  // bodies of a lattice that share no cell may still overlap by part of one
  out.audit = record.audit_passed() &&
              (packs_on_lattice(scene.method) || analysis.overlap->max <= scene.overlap_limit);
  out.radial = analysis.radial.exact;
  out.hash = record.bed_hash;
  return out;
}

}  // namespace packbed::bench
