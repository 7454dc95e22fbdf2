#pragma once
// report.html: one self-contained page that opens offline and shows what the bed is like.
#include <optional>
#include <string>
#include <vector>

#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"
#include "bed/scene.hpp"

namespace packbed {

/// A bulk packing density measured elsewhere on the same pellets in the same container.
struct ReferenceDensity {
  std::string label;   // "CT, poured, 4 beds"
  double mean = 0;     // packing density [-]
  double sd = 0;       // of the axial profile within a bed [-]
  std::string source;  // where the number is from
};

/// The rows of a table like cases/reference/ct_beds.csv that belong to a pellet in a container, by the names
/// that the case gives them ("a38", "lc"; state "poured" or "tapped"). `table` may be empty: then it is that
/// very table, which is part of the program. Empty when nothing fits; throws InputError when the table cannot
/// be read.
std::vector<ReferenceDensity> find_references(const std::string& table, const std::string& pellet,
                                              const std::string& container, const std::string& state);

/// Throws SystemError. `record` may be null (a bed that was not packed here).
void write_report(const std::string& path, const PackedBed& bed, const RunRecord* record,
                  const AnalysisResult& analysis, const Scene* scene,
                  const std::vector<ReferenceDensity>& references);

}  // namespace packbed
