#include "io/size_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "io/csv_table.hpp"
#include "io/result_folder.hpp"
#include "io/size_study_lines.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

using Json = nlohmann::json;

constexpr double kNaN = LawLine::kNone;

double number_at(const Json& json, const Json::json_pointer& at) {
  return json.contains(at) && json.at(at).is_number() ? json.at(at).get<double>() : kNaN;
}

StudyBed read_bed_of_study(const std::string& input) {
  const std::string path = file_in(input, result_file::kSummary);
  try {
    const Json s = Json::parse(read_file(path));
    const auto number = [&](const char* at) { return number_at(s, Json::json_pointer(at)); };
    StudyBed bed;
    bed.name = s.at("case").get<std::string>();
    bed.audit = s.at("audit").get<std::string>();
    bed.seed = s.at("seed").get<unsigned long long>();
    bed.pellets = s.at("/pellets/inside"_json_pointer).get<int>();
    bed.smallest_m = number("/bed/smallest_m");
    bed.largest_m = number("/bed/largest_m");
    bed.height_m = number("/bed/height_m");
    bed.porosity = number("/bed/core_porosity");
    bed.shots = number("/bed/core/shots");
    bed.shots_error = number("/bed/core/shots_error");
    bed.segregation = number("/bed/segregation");
    bed.coordination = number("/bed/coordination/core_bearing");
    bed.cpu_s = number("/time/cpu_s");
    bed.wall_s = number("/time/wall_s");
    for (const Json& row : s.value("sizes", Json::array()))
      bed.sizes.push_back({row.at("diameter_m").get<double>(), row.at("volume").get<double>()});
    if (!(bed.smallest_m > 0) || !(bed.largest_m > 0))
      throw InputError(path, "no size of the pellets", "the summary of a bed that was analysed");
    return bed;
  } catch (const Json::exception& e) {
    throw InputError(path, e.what(), "the summary.json of a finished run");
  }
}

std::optional<PowerLaw> fit_with_published_n(const Study& study, const std::vector<double>& x,
                                             const std::vector<double>& y) {
  const double n = published_value(study, "n");
  if (!std::isfinite(n)) return {};
  try {
    return fit_power_law_of(n, x, y);
  } catch (const InputError&) {
    return {};  // too few, as the law's own message says
  }
}

}  // namespace

std::vector<StudyBed> read_study(const std::vector<std::string>& folders) {
  std::vector<StudyBed> beds;
  for (const std::string& folder : folders) beds.push_back(read_bed_of_study(folder));
  std::stable_sort(beds.begin(), beds.end(), [](const StudyBed& a, const StudyBed& b) {
    return std::pair(a.smallest_m, a.pellets) < std::pair(b.smallest_m, b.pellets);
  });
  return beds;
}

std::map<std::string, Published> read_published(const std::string& path) {
  const CsvTable table = read_csv_table(path, "published numbers");
  if (table.header.cells != std::vector<std::string>{"quantity", "value", "low", "high"})
    throw InputError(table.header.where, fmt::format("{}", fmt::join(table.header.cells, ",")),
                     "quantity,value,low,high");
  std::map<std::string, Published> out;
  for (const CsvLine& line : table.lines) {
    const auto number = [&](std::size_t i) {
      return line.cells[i].empty() ? kNaN : csv_number(line.cells[i], line.where);
    };
    out[line.cells[0]] = {number(1), number(2), number(3)};
  }
  return out;
}

Study make_study(std::vector<StudyBed> beds, std::map<std::string, Published> published) {
  Study study{std::move(beds), std::move(published), {}, "", {}};
  const double alone = of_equal_pellets(study).value;
  for (StudyBed& b : study.beds)
    b.model = b.of_equal_pellets() ? alone : std::isfinite(alone) ? mixture_porosity(b.sizes, alone) : kNaN;
  std::vector<double> x, y;
  for (const StudyBed& b : study.beds)
    if (std::isfinite(b.porosity)) {
      x.push_back(b.ratio());
      y.push_back(b.porosity);
    }
  try {
    study.law = fit_power_law(x, y);
  } catch (const InputError& e) {
    study.no_law = e.what();
    study.with_published_n = fit_with_published_n(study, x, y);
  }
  return study;
}

}  // namespace packbed
