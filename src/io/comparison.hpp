#pragma once
// Beds and grids side by side: as a text table, as CSV and as a page.
#include <optional>
#include <string>
#include <vector>

#include "analysis/compare.hpp"
#include "bed/run_record.hpp"

namespace packbed {

struct Compared {
  std::string name;  // of the folder or file
  AnalysisResult analysis;
  std::optional<RunRecord> record;  // of the run, where there was one
};

/// A line each: bulk density and its spread, distances from the first, time, memory.
std::string comparison_text(const std::vector<Compared>& beds);
/// comparison.csv (the table), axial.csv and radial.csv (name,x_dp,density), orientation.csv
/// (name,from_deg,to_deg,fraction), comparison.html (all of it, offline). Whole or not at all; SystemError.
void write_comparison(const std::string& folder, const std::vector<Compared>& beds);

}  // namespace packbed
