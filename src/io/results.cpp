#include "io/results.hpp"

#include <filesystem>

#include "io/atomic_file.hpp"
#include "io/bed.hpp"
#include "io/curves.hpp"
#include "io/grid.hpp"
#include "io/report.hpp"
#include "io/summary.hpp"
#include "io/vtu.hpp"

namespace packbed {
namespace {

void write_voxels(const ResultFolder& folder, const Scene& scene, const RunRecord& record,
                  const AnalysisResult& analysis, const VoxelGrid* grid) {
  if (!scene.output.voxels || !grid) return;
  write_grid(folder.file(result_file::kVoxels), *grid,
             {scene.container.radius, analysis.bulk.diameter_m, record.bed_hash});
}

void write_paraview(const ResultFolder& folder, const Scene& scene, const PackedBed& bed,
                    const AnalysisResult& analysis) {
  if (!scene.output.vtk) return;
  CellFields fields;
  if (analysis.overlap) fields.overlap = analysis.overlap->pellet;
  write_vtu(folder.file(result_file::kBedVtu), bed, fields);
  write_container_vtu(folder.file(result_file::kContainerVtu), bed.container);
}

/// A mixture is not what the tables of references are about.
std::vector<ReferenceDensity> references_of(const Scene& scene) {
  if (scene.pellets.size() != 1) return {};
  return find_references("", scene.pellets[0].shape->name, scene.container.name, "poured");
}

}  // namespace

std::string write_results(const ResultFolder& folder, const Scene& scene, const PackedBed& bed,
                          const RunRecord& record, const AnalysisResult& analysis, const VoxelGrid* grid) {
  write_bed(folder.file(result_file::kBed), bed, &record);
  write_poses_csv(folder.file(result_file::kPoses), bed);
  write_curves(folder, analysis);
  write_voxels(folder, scene, record, analysis, grid);
  write_paraview(folder, scene, bed, analysis);
  std::string report;
  if (scene.output.report) {
    report = folder.file(result_file::kReport);
    write_report(report, bed, &record, analysis, &scene, references_of(scene));
  }
  write_atomically(folder.file(result_file::kSummary), summary_json(scene, record, analysis));
  std::error_code ignored;
  std::filesystem::remove(folder.file(result_file::kCheckpoint), ignored);
  return report;
}

}  // namespace packbed
