#include "cli/finish.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "analysis/analyse.hpp"
#include "analysis/size_rows.hpp"
#include "io/results.hpp"
#include "io/summary.hpp"

namespace packbed::cli {
namespace {

void audit_overlap(RunRecord& record, const Scene& scene, const AnalysisResult& analysis) {
  if (!analysis.overlap) return;
  const OverlapAudit& o = *analysis.overlap;
  record.overlap.rest_mean = o.mean;
  record.overlap.rest_max = o.max;
  if (packs_on_lattice(scene.method)) {  // bodies that share no cell may still overlap by less than a cell
    record.notes.push_back(fmt::format(
        "the bodies behind the cells overlap by {:.2f} % of the thickness in the mean of {} touching "
        "pairs, at most by {:.1f} %",
        100 * o.mean, o.pairs, 100 * o.max));
    return;
  }
  record.audit.push_back(
      {"overlap", o.max <= scene.overlap_limit,
       fmt::format(
           "measured from geometry: mean {:.3f} %, largest {:.3f} % of the thickness over {} touching pairs "
           "(limit {:.2f} %)",
           100 * o.mean, 100 * o.max, o.pairs, 100 * scene.overlap_limit)});
}

}  // namespace

int finish(const ResultFolder& folder, const Scene& scene, PackResult& result) {
  VoxelGrid grid = std::move(result.grid);
  AnalysisResult analysis = analyse_bed(result.bed, scene.analysis, &grid);
  add_asked(analysis.sizes, scene.pellets);
  audit_overlap(result.record, scene, analysis);
  const std::string report =
      write_results(folder, scene, result.bed, result.record, analysis, grid.words.empty() ? nullptr : &grid);
  std::fputs(summary_text(scene, result.record, analysis, folder.path, report).c_str(), stdout);
  return result.record.audit_passed() ? 0 : 1;
}

}  // namespace packbed::cli
