#pragma once
// The result folder of a run that has ended, in one call (docs/results.md).
#include <string>

#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"
#include "bed/scene.hpp"
#include "io/result_folder.hpp"
#include "lattice/voxel_grid.hpp"

namespace packbed {

/// Writes bed.h5, poses.csv, the curves, and as scene.output wishes voxels.h5 (of `grid`, when given), the
/// ParaView files and report.html; summary.json last, so that where it is, all is. Then removes the
/// checkpoint. Gives the path of the report, empty without one. Throws SystemError.
std::string write_results(const ResultFolder& folder, const Scene& scene, const PackedBed& bed,
                          const RunRecord& record, const AnalysisResult& analysis,
                          const VoxelGrid* grid = nullptr);

}  // namespace packbed
