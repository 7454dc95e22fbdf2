#include "cli/finish.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "analysis/analyse.hpp"
#include "io/atomic_file.hpp"
#include "io/bed.hpp"
#include "io/curves.hpp"
#include "io/grid.hpp"
#include "io/report.hpp"
#include "io/summary.hpp"
#include "io/vtu.hpp"

namespace packbed::cli {
namespace {

void audit_overlap(RunRecord& record, const Scene& scene, const AnalysisResult& analysis) {
  if (!analysis.overlap) return;
  const OverlapAudit& o = *analysis.overlap;
  record.overlap.rest_mean = o.mean;
  record.overlap.rest_max = o.max;
  record.audit.push_back(
      {"overlap", o.max <= scene.overlap_limit,
       fmt::format(
           "measured from geometry: mean {:.3f} %, largest {:.3f} % of the thickness over {} touching pairs "
           "(limit {:.2f} %)",
           100 * o.mean, 100 * o.max, o.pairs, 100 * scene.overlap_limit)});
}

}  // namespace

int finish(const ResultFolder& folder, const Scene& scene, PackResult& result) {
  VoxelGrid grid;
  const AnalysisResult analysis = analyse_bed(result.bed, scene.analysis, &grid);
  audit_overlap(result.record, scene, analysis);
  write_bed(folder.file(result_file::kBed), result.bed, &result.record);
  write_poses_csv(folder.file(result_file::kPoses), result.bed);
  write_curves(folder, analysis);
  if (scene.output.vtk) {
    write_vtu(folder.file(result_file::kBedVtu), result.bed,
              {analysis.overlap ? analysis.overlap->pellet : std::vector<double>{}});
    write_container_vtu(folder.file(result_file::kContainerVtu), result.bed.container);
  }
  if (scene.output.voxels && !grid.words.empty())
    write_grid(folder.file(result_file::kVoxels), grid,
               {result.bed.container.radius, analysis.bulk.diameter_m, result.record.bed_hash});
  std::string report;
  if (scene.output.report) {
    report = folder.file(result_file::kReport);
    const std::string pellet = scene.pellets.empty() ? "" : scene.pellets.front().shape->name;
    write_report(report, result.bed, &result.record, analysis, &scene,
                 find_references("", pellet, scene.container.name, "poured"));
  }
  // last: a folder with a summary is a finished one
  write_atomically(folder.file(result_file::kSummary), summary_json(scene, result.record, analysis));
  std::error_code ignored;
  std::filesystem::remove(folder.file(result_file::kCheckpoint), ignored);
  std::fputs(summary_text(scene, result.record, analysis, folder.path, report).c_str(), stdout);
  return result.record.audit_passed() ? 0 : 1;
}

}  // namespace packbed::cli
