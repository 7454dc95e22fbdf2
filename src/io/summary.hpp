#pragma once
// What a run tells in a few numbers: for programs (summary.json) and for people (the text at the end of a
// run).
#include <optional>
#include <string>

#include "analysis/results.hpp"
#include "bed/run_record.hpp"
#include "bed/scene.hpp"

namespace packbed {

/// summary.json as docs/results.md describes it, SI units. Numbers that do not exist (NaN) are null.
/// `analysis` may be empty: then the bed's keys are null.
std::string summary_json(const Scene& scene, const RunRecord& record,
                         const std::optional<AnalysisResult>& analysis);

/// Aligned lines with units, ending with the path of the report when `report_path` is not empty.
std::string summary_text(const Scene& scene, const RunRecord& record,
                         const std::optional<AnalysisResult>& analysis, const std::string& folder,
                         const std::string& report_path);

/// Core, segregation, coordination and sizes of a bed as summary.json has them.
std::string mixture_json(const AnalysisResult& analysis);

/// The record as JSON and back, bit for bit.
std::string record_json(const RunRecord& record);
RunRecord record_from_json(const std::string& json);  ///< throws InputError

}  // namespace packbed
