#pragma once
// The curves of an analysis as CSV files, one a curve, units in the column names (docs/results.md).
#include "analysis/results.hpp"
#include "io/result_folder.hpp"

namespace packbed {

/// axial.csv, radial.csv, planar.csv, orientation.csv, angles.csv: those that the analysis holds. Throws
/// SystemError.
void write_curves(const ResultFolder& folder, const AnalysisResult& analysis);

}  // namespace packbed
