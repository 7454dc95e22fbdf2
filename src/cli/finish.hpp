#pragma once
// The end of a run: analysis, audit of the overlaps, all files of the result folder, the summary on the
// screen.
#include "bed/scene.hpp"
#include "io/result_folder.hpp"
#include "packers/packer.hpp"

namespace packbed::cli {

/// Returns the exit code: 0, or 1 when the audit failed.
int finish(const ResultFolder& folder, const Scene& scene, PackResult& result);

}  // namespace packbed::cli
