#include "io/summary.hpp"

#include <nlohmann/json.hpp>

#include "math/error.hpp"

namespace packbed {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order of docs/results.md; NaN becomes null

Json audit_lines(const RunRecord& r) {
  Json lines = Json::array();
  for (const AuditLine& line : r.audit)
    lines.push_back({{"name", line.name}, {"passed", line.passed}, {"finding", line.finding}});
  return lines;
}

Json pellets_of(const RunRecord& r) {
  return {{"asked", r.pellets.asked},
          {"fed", r.pellets.fed},
          {"inside", r.pellets.inside},
          {"escaped", r.pellets.escaped}};
}

Json time_of(const RunRecord& r) {
  return {{"wall_s", r.time.wall_s},
          {"cpu_s", r.time.cpu_s},
          {"setup_s", r.time.setup_s},
          {"steps", r.time.steps},
          {"step_s", r.time.step_s},
          {"simulated_s", r.time.simulated_s},
          {"phases_s", r.time.phases_s.empty() ? Json::object() : Json(r.time.phases_s)}};
}

Json overlap_of(const RunRecord& r) {
  return {{"rest_mean", r.overlap.rest_mean},
          {"rest_max", r.overlap.rest_max},
          {"peak", r.overlap.peak},
          {"share_above_5_percent", r.overlap.share_above_5_percent},
          {"unit", "fraction of the pellet's smallest thickness"}};
}

Json energy_of(const RunRecord& r) {
  return {{"input", r.energy.input},
          {"kinetic", r.energy.kinetic},
          {"potential", r.energy.potential},
          {"elastic", r.energy.elastic},
          {"damped", r.energy.damped},
          {"rubbed", r.energy.rubbed},
          {"removed", r.energy.removed},
          {"ledger_error", r.energy.ledger_error},
          {"unit", "J; ledger_error is a fraction of input"}};
}

Json wall_of(const RunRecord& r) {
  return {{"base_force_N", r.wall.base_force_N},
          {"side_shear_N", r.wall.side_shear_N},
          {"weight_N", r.wall.weight_N}};
}

Json core_of(const CorePorosity& c) {
  return {{"exact", c.exact},         {"voxels", c.voxels},
          {"shots", c.shots},         {"shots_error", c.shots_error},
          {"cells", c.cells},         {"cell_m", c.cell_m},
          {"cell_sd", c.cell_sd},     {"shots_per_cell", c.shots_per_cell},
          {"margin_m", c.margin_m},   {"z_range_m", c.z_range_m},
          {"volume_m3", c.volume_m3}, {"definition", c.definition}};
}

Json coordination_of(const Coordination& c) {
  return {{"mean", c.mean},
          {"core", c.core},
          {"core_bearing", c.core_bearing},
          {"rattlers", c.rattlers},
          {"from", c.source}};
}

/// Asked and obtained; empty when all pellets are alike.
Json sizes_of(const AnalysisResult& analysis) {
  Json rows = Json::array();
  for (const SizeRow& r : analysis.sizes)
    rows.push_back({{"shape", r.shape},
                    {"from_m", r.from_m},
                    {"to_m", r.to_m},
                    {"diameter_m", r.diameter_m},
                    {"count", r.count},
                    {"number", r.number},
                    {"volume", r.volume},
                    {"asked_number", r.asked_number},
                    {"asked_volume", r.asked_volume}});
  return rows;
}

Json taps_of(const RunRecord& r) {
  Json taps = Json::array();
  for (const TapRecord& t : r.taps)
    taps.push_back({{"tap", t.number},
                    {"time_s", t.time_s},
                    {"packing_density", t.packing_density},
                    {"top_m", t.top_m}});
  return taps;
}

Json bed_of(const std::optional<AnalysisResult>& analysis) {
  Json bed = {{"height_m", nullptr},   {"packing_density", nullptr}, {"exact_packing_density", nullptr},
              {"axial_sd", nullptr},   {"z_range_m", nullptr},       {"voxel_m", nullptr},
              {"diameter_m", nullptr}, {"definition", nullptr},      {"core_porosity", nullptr},
              {"core", nullptr},       {"segregation", nullptr},     {"coordination", nullptr},
              {"smallest_m", nullptr}, {"largest_m", nullptr}};
  if (!analysis) return bed;
  const BulkDensity& bulk = analysis->bulk;
  bed["height_m"] = analysis->bed_height_m;
  bed["packing_density"] = bulk.packing_density;
  bed["exact_packing_density"] = bulk.exact;
  bed["axial_sd"] = bulk.axial_sd;
  bed["z_range_m"] = bulk.z_range_m;
  bed["voxel_m"] = bulk.voxel_m;
  bed["diameter_m"] = bulk.diameter_m;
  bed["definition"] = bulk.definition;
  bed["smallest_m"] = analysis->smallest_m;
  bed["largest_m"] = analysis->largest_m;
  if (analysis->core) {
    bed["core_porosity"] = analysis->core->best();
    bed["core"] = core_of(*analysis->core);
  }
  if (analysis->segregation) bed["segregation"] = analysis->segregation->along[2];
  if (analysis->coordination) bed["coordination"] = coordination_of(*analysis->coordination);
  return bed;
}

Json container_of(const Scene& scene) {
  const Container& c = scene.container;
  return {{"name", c.name},
          {"kind", std::string(to_string(c.kind))},
          {"inner_radius_m", c.radius},
          {"height_m", c.height}};
}

Json shapes_of(const Scene& scene) {
  Json shapes = Json::array();
  for (const PelletKind& kind : scene.pellets) {
    const Shape& s = *kind.shape;
    shapes.push_back({{"name", s.name},
                      {"source", s.source},
                      {"class", std::string(to_string(s.kind))},
                      {"density_kg_m3", kind.density},
                      {"share", kind.share},
                      {"volume_m3", s.volume},
                      {"area_m2", s.area},
                      {"equivalent_diameter_m", s.equivalent_diameter()},
                      {"smallest_thickness_m", s.smallest_thickness}});
  }
  return shapes;
}

Json analysis_cost(const std::optional<AnalysisResult>& analysis) {
  if (!analysis) return nullptr;
  return {{"voxelise_cpu_s", analysis->voxelise_cpu_s}, {"analyse_cpu_s", analysis->analyse_cpu_s}};
}

}  // namespace

std::string summary_json(const Scene& scene, const RunRecord& r,
                         const std::optional<AnalysisResult>& analysis) {
  const Json summary = {{"packbed", PACKBED_VERSION},
                        {"case", scene.name},
                        {"case_file", scene.case_file},
                        {"method", r.method},
                        {"kernel", r.kernel},
                        {"seed", r.seed},
                        {"threads", r.threads},
                        {"bed_hash", r.bed_hash},
                        {"pellets", pellets_of(r)},
                        {"at_rest", r.at_rest},
                        {"audit", r.audit_passed() ? "passed" : "failed"},
                        {"audit_lines", audit_lines(r)},
                        {"time", time_of(r)},
                        {"analysis_time", analysis_cost(analysis)},
                        {"memory", {{"peak_rss_bytes", r.peak_rss_bytes}}},
                        {"overlap", overlap_of(r)},
                        {"energy", energy_of(r)},
                        {"wall", wall_of(r)},
                        {"taps", taps_of(r)},
                        {"bed", bed_of(analysis)},
                        {"container", container_of(scene)},
                        {"shapes", shapes_of(scene)},
                        {"sizes", analysis ? sizes_of(*analysis) : Json::array()},
                        {"counters", r.counters.empty() ? Json::object() : Json(r.counters)},
                        {"notes", r.notes}};
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string mixture_json(const AnalysisResult& a) {
  const Json mixture = {{"core", a.core ? core_of(*a.core) : Json(nullptr)},
                        {"segregation", a.segregation ? Json(a.segregation->along[2]) : Json(nullptr)},
                        {"coordination", a.coordination ? coordination_of(*a.coordination) : Json(nullptr)},
                        {"sizes", sizes_of(a)}};
  return mixture.dump();
}

std::string record_json(const RunRecord& r) {
  const Json record = {{"method", r.method},
                       {"kernel", r.kernel},
                       {"bed_hash", r.bed_hash},
                       {"seed", r.seed},
                       {"threads", r.threads},
                       {"pellets", pellets_of(r)},
                       {"at_rest", r.at_rest},
                       {"audit_lines", audit_lines(r)},
                       {"time", time_of(r)},
                       {"memory", {{"peak_rss_bytes", r.peak_rss_bytes}}},
                       {"overlap", overlap_of(r)},
                       {"energy", energy_of(r)},
                       {"taps", taps_of(r)},
                       {"wall", wall_of(r)},
                       {"counters", r.counters.empty() ? Json::object() : Json(r.counters)},
                       {"notes", r.notes}};
  return record.dump(-1, ' ', false, Json::error_handler_t::replace);
}

namespace {

/// A number that was NaN was written as null.
double number(const Json& object, const char* key) {
  const Json& value = object.at(key);
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

std::map<std::string, double> numbers(const Json& object) {
  std::map<std::string, double> out;
  for (const auto& [key, value] : object.items()) out[key] = number(object, key.c_str());
  return out;
}

void read_time(const Json& j, RunRecord& r) {
  r.time.wall_s = number(j, "wall_s");
  r.time.cpu_s = number(j, "cpu_s");
  r.time.setup_s = number(j, "setup_s");
  r.time.steps = j.at("steps");
  r.time.step_s = number(j, "step_s");
  r.time.simulated_s = number(j, "simulated_s");
  r.time.phases_s = numbers(j.at("phases_s"));
}

void read_physics(const Json& j, RunRecord& r) {
  const Json &overlap = j.at("overlap"), &energy = j.at("energy"), &wall = j.at("wall");
  r.overlap = {number(overlap, "rest_mean"), number(overlap, "rest_max"), number(overlap, "peak"),
               number(overlap, "share_above_5_percent")};
  r.energy = {number(energy, "input"),   number(energy, "kinetic"),     number(energy, "potential"),
              number(energy, "elastic"), number(energy, "damped"),      number(energy, "rubbed"),
              number(energy, "removed"), number(energy, "ledger_error")};
  r.wall = {number(wall, "base_force_N"), number(wall, "side_shear_N"), number(wall, "weight_N")};
}

}  // namespace

RunRecord record_from_json(const std::string& text) try {
  const Json j = Json::parse(text);
  RunRecord r;
  r.method = j.at("method");
  r.kernel = j.at("kernel");
  r.bed_hash = j.at("bed_hash");
  r.seed = j.at("seed");
  r.threads = j.at("threads");
  const Json& pellets = j.at("pellets");
  r.pellets = {pellets.at("asked"), pellets.at("fed"), pellets.at("inside"), pellets.at("escaped")};
  r.at_rest = j.at("at_rest");
  for (const Json& line : j.at("audit_lines"))
    r.audit.push_back({line.at("name"), line.at("passed"), line.at("finding")});
  read_time(j.at("time"), r);
  r.peak_rss_bytes = j.at("memory").at("peak_rss_bytes");
  read_physics(j, r);
  for (const Json& t : j.value("taps", Json::array()))
    r.taps.push_back({t.at("tap"), number(t, "time_s"), number(t, "packing_density"), number(t, "top_m")});
  r.counters = numbers(j.at("counters"));
  r.notes = j.at("notes").get<std::vector<std::string>>();
  return r;
} catch (const Json::exception& e) {
  throw InputError("record of a run", e.what(), "the JSON of record_json");
}

}  // namespace packbed
