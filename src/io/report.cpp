#include "io/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "io/atomic_file.hpp"
#include "io/chart.hpp"
#include "io/report/assets.hpp"
#include "io/summary.hpp"

namespace packbed {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "the page reads little-endian arrays");

std::string base64(std::span<const std::byte> bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      word = (word << 8) | (k < have ? static_cast<std::uint32_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) out += k <= have ? digits[(word >> (18 - 6 * k)) & 63] : '=';
  }
  return out;
}

/// {"f32": "..."}: a typed array of the page.
template <class T>
Json typed(const char* type, const std::vector<T>& values) {
  return {{type, base64(std::as_bytes(std::span(values)))}};
}
Json floats(const std::vector<float>& values) {
  return typed("f32", values);
}
Json floats(const std::vector<double>& values) {
  return floats(std::vector<float>(values.begin(), values.end()));
}

void put_surface(Json& json, const TriangleMesh& mesh) {
  std::vector<float> vertices;
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(v[k]));
  std::vector<std::uint32_t> triangles;
  for (const auto& t : mesh.triangles)
    for (const std::int32_t corner : t) triangles.push_back(static_cast<std::uint32_t>(corner));
  json["vertices"] = floats(vertices);
  json["triangles"] = typed("u32", triangles);
}

Json shape_json(const Shape& shape, double density) {
  Json json = {{"name", shape.name},
               {"source", shape.source},
               {"class", std::string(to_string(shape.kind))},
               {"radius_m", shape.radius},
               {"half_height_m", shape.half_height},
               {"volume_m3", shape.volume},
               {"equivalent_diameter_m", shape.equivalent_diameter()},
               {"bounding_radius_m", shape.bounding_radius},
               {"density_kg_m3", density}};
  if (seen_as_mesh(shape.kind)) put_surface(json, shape.surface);
  return json;
}

Json container_json(const Container& container) {
  Json json = {{"name", container.name},
               {"source", container.source},
               {"kind", std::string(to_string(container.kind))},
               {"radius_m", container.radius},
               {"width_m", container.width},
               {"depth_m", container.depth},
               {"height_m", container.height}};
  if (container.kind == ContainerKind::mesh) put_surface(json, container.surface);
  return json;
}

Json pellets_json(const PackedBed& bed, const AnalysisResult& analysis) {
  std::vector<float> position, rotation, scale, overlap;
  std::vector<std::uint16_t> shape;
  bool scaled = false;
  for (const Pellet& p : bed.pellets) {
    for (int k = 0; k < 3; ++k) position.push_back(static_cast<float>(p.pose.position[k]));
    for (int k = 0; k < 4; ++k)
      rotation.push_back(static_cast<float>(p.pose.rotation.coeffs()[k]));  // x, y, z, w
    scale.push_back(static_cast<float>(p.scale));
    shape.push_back(static_cast<std::uint16_t>(p.shape));
    scaled = scaled || p.scale != 1;
  }
  Json json = {{"count", bed.pellets.size()},
               {"position", floats(position)},
               {"rotation", floats(rotation)},
               {"shape", typed("u16", shape)},
               {"scale", scaled ? floats(scale) : Json(nullptr)},
               {"overlap", nullptr}};
  if (analysis.overlap && analysis.overlap->pellet.size() == bed.pellets.size())
    json["overlap"] = floats(analysis.overlap->pellet);
  return json;
}

Json profile_json(const Profile& profile) {
  return {
      {"x_dp", floats(profile.x_dp)}, {"density", floats(profile.density)}, {"exact", floats(profile.exact)}};
}

/// One byte a cell is enough for a picture: 0 to 254 for 0 to 1, 255 outside the container.
Json planar_json(const std::optional<PlanarMap>& map) {
  if (!map) return nullptr;
  std::vector<std::uint8_t> cells;
  for (const float d : map->density)
    cells.push_back(std::isfinite(d) ? static_cast<std::uint8_t>(std::lround(254 * std::clamp(d, 0.0F, 1.0F)))
                                     : 255);
  return {{"size", map->size}, {"pitch", map->pitch}, {"density", typed("u8", cells)}};
}

Json orientation_json(const std::optional<Orientation>& o) {
  if (!o) return nullptr;
  std::vector<float> lambert;
  for (const auto& point : o->lambert)
    for (const double x : point) lambert.push_back(static_cast<float>(x));
  return {{"from_deg", o->from_deg}, {"to_deg", o->to_deg},       {"count", o->count},
          {"fraction", o->fraction}, {"isotropic", o->isotropic}, {"lambert", floats(lambert)}};
}

Json bulk_json(const BulkDensity& bulk) {
  return {{"packing_density", bulk.packing_density},
          {"exact", bulk.exact},
          {"axial_sd", bulk.axial_sd},
          {"z_range_m", bulk.z_range_m},
          {"voxel_m", bulk.voxel_m},
          {"diameter_m", bulk.diameter_m},
          {"definition", bulk.definition}};
}

Json references_json(const std::vector<ReferenceDensity>& references) {
  Json json = Json::array();
  for (const ReferenceDensity& r : references)
    json.push_back({{"label", r.label}, {"mean", r.mean}, {"sd", r.sd}, {"source", r.source}});
  return json;
}

Json provenance_json(const Provenance& from) {
  return {{"case_file", from.case_file},
          {"case_text", from.case_text},
          {"version", from.version},
          {"method", from.method},
          {"seed", std::to_string(from.seed)},  // 64 bits: more than a page's
                                                // numbers hold
          {"kernel", from.kernel}};
}

std::string title_of(const PackedBed& bed, const Scene* scene) {
  if (scene && !scene->name.empty()) return scene->name;
  return bed.provenance.case_file.empty() ? "packed bed" : bed.provenance.case_file;
}

Json page_data(const PackedBed& bed, const RunRecord* record, const AnalysisResult& analysis,
               const Scene* scene, const std::vector<ReferenceDensity>& references) {
  Json shapes = Json::array();
  for (std::size_t i = 0; i < bed.shapes.size(); ++i)
    shapes.push_back(shape_json(*bed.shapes[i], i < bed.densities.size() ? bed.densities[i] : NAN));
  return {{"title", title_of(bed, scene)},
          {"bed_hash", bed_hash(bed)},
          {"provenance", provenance_json(bed.provenance)},
          {"run", record ? Json::parse(record_json(*record)) : Json(nullptr)},
          {"bed_height_m", analysis.bed_height_m},
          {"bulk", bulk_json(analysis.bulk)},
          {"analysis_time",
           {{"voxelise_cpu_s", analysis.voxelise_cpu_s}, {"analyse_cpu_s", analysis.analyse_cpu_s}}},
          {"references", references_json(references)},
          {"shapes", std::move(shapes)},
          {"container", container_json(bed.container)},
          {"pellets", pellets_json(bed, analysis)},
          {"axial", profile_json(analysis.axial)},
          {"radial", profile_json(analysis.radial)},
          {"planar", planar_json(analysis.planar)},
          {"orientation", orientation_json(analysis.orientation)},
          {"mixture", Json::parse(mixture_json(analysis))}};
}

/// JSON that cannot end the script element that it stands in.
std::string script_safe(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

/// The page with every @NAME@ replaced; what is put in is not searched again.
std::string filled_page(const std::vector<std::pair<std::string_view, std::string_view>>& values) {
  std::string_view page = report::page();
  std::string out;
  while (!page.empty()) {
    const std::size_t at = page.find('@');
    out += page.substr(0, at);
    if (at == std::string_view::npos) break;
    const std::size_t end = page.find('@', at + 1);
    const std::string_view name = page.substr(at + 1, end - at - 1);
    for (const auto& [key, value] : values)
      if (key == name) out += value;
    page.remove_prefix(end + 1);
  }
  return out;
}

}  // namespace

void write_report(const std::string& path, const PackedBed& bed, const RunRecord* record,
                  const AnalysisResult& analysis, const Scene* scene,
                  const std::vector<ReferenceDensity>& references) {
  const std::string title = html_text(title_of(bed, scene));
  const std::string data = script_safe(page_data(bed, record, analysis, scene, references));
  std::string summary = title;
  if (record && scene) summary = html_text(summary_text(*scene, *record, analysis, "", ""));
  write_atomically(path, filled_page({{"TITLE", title},
                                      {"STYLE", report::style()},
                                      {"SUMMARY", summary},
                                      {"DATA", data},
                                      {"SCRIPT", report::script()}}));
}

}  // namespace packbed
