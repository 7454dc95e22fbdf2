// summary.json holds every key that other programs rely on, with its type and its meaning.
#include "io/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/sample_bed.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

using Json = nlohmann::json;

Json sample_summary() {
  return Json::parse(summary_json(sample_scene(), sample_record(), sample_analysis(sample_bed())));
}

TEST(Summary, HoldsEveryAgreedKeyWithItsType) {
  const Json s = sample_summary();
  for (const char* key :
       {"/packbed", "/case", "/method", "/kernel", "/bed_hash", "/audit", "/overlap/unit", "/bed/definition"})
    EXPECT_TRUE(s.at(Json::json_pointer(key)).is_string()) << key;
  for (const char* key : {"/seed", "/threads", "/pellets/asked", "/pellets/fed", "/pellets/inside",
                          "/pellets/escaped", "/time/steps", "/memory/peak_rss_bytes"})
    EXPECT_TRUE(s.at(Json::json_pointer(key)).is_number_integer()) << key;
  for (const char* key :
       {"/time/wall_s", "/time/cpu_s", "/time/setup_s", "/time/step_s", "/time/simulated_s",
        "/time/phases_s/find_pairs", "/overlap/rest_mean", "/overlap/rest_max", "/overlap/peak",
        "/energy/ledger_error", "/wall/base_force_N", "/wall/side_shear_N", "/wall/weight_N", "/bed/height_m",
        "/bed/packing_density", "/bed/axial_sd", "/bed/z_range_m/0", "/bed/z_range_m/1", "/bed/voxel_m"})
    EXPECT_TRUE(s.at(Json::json_pointer(key)).is_number()) << key;
  EXPECT_TRUE(s.at("at_rest").is_boolean());
  EXPECT_EQ(s.at("bed").at("z_range_m").size(), 2u);
  EXPECT_TRUE(s.at("bed").at("core_porosity").is_null());
  EXPECT_TRUE(s.at("bed").at("segregation").is_null());
}

TEST(Summary, HoldsCoreSegregationContactsAndSizesWhereThereAreSome) {
  AnalysisResult a = sample_analysis(sample_bed());
  a.smallest_m = 1e-3;
  a.largest_m = 2e-3;
  a.core.emplace();
  a.core->voxels = 0.41;
  a.core->shots = 0.42;
  a.segregation.emplace();
  a.segregation->along = {0.1, 0.2, 0.3};
  a.coordination.emplace();
  a.coordination->mean = 5.5;
  a.sizes = {{.diameter_m = 2e-3, .count = 7, .number = 1, .volume = 1}};
  const Json s = Json::parse(summary_json(sample_scene(), sample_record(), a));
  EXPECT_EQ(s["bed"]["core_porosity"], 0.41) << "voxels come before shots";
  EXPECT_EQ(s["bed"]["core"]["shots"], 0.42);
  EXPECT_TRUE(s["bed"]["core"]["exact"].is_null());
  EXPECT_EQ(s["bed"]["segregation"], 0.3) << "along the height";
  EXPECT_EQ(s["bed"]["coordination"]["mean"], 5.5);
  EXPECT_EQ(s["bed"]["largest_m"], 2e-3);
  ASSERT_EQ(s["sizes"].size(), 1u);
  EXPECT_EQ(s["sizes"][0]["count"], 7);
  EXPECT_TRUE(s["sizes"][0]["asked_number"].is_null());
}

TEST(Summary, SaysWhatTheRecordSays) {
  const Json s = sample_summary();
  const RunRecord r = sample_record();
  EXPECT_EQ(s["seed"].get<std::uint64_t>(), r.seed) << "all 64 bits";
  EXPECT_EQ(s["audit"], "failed") << "one line of the audit failed";
  EXPECT_EQ(s["audit_lines"].size(), r.audit.size());
  EXPECT_EQ(s["pellets"]["escaped"], 1);
  EXPECT_EQ(s["time"]["simulated_s"].get<double>(), r.time.simulated_s);
  EXPECT_EQ(s["overlap"]["rest_max"].get<double>(), r.overlap.rest_max);
  EXPECT_EQ(s["energy"]["ledger_error"].get<double>(), r.energy.ledger_error);
  EXPECT_EQ(s["bed"]["packing_density"].get<double>(), sample_analysis(sample_bed()).bulk.packing_density);
}

TEST(Summary, ANumberThatDoesNotExistIsNull) {
  AnalysisResult analysis = sample_analysis(sample_bed());
  analysis.bulk.packing_density = std::numeric_limits<double>::quiet_NaN();
  Json s = Json::parse(summary_json(sample_scene(), sample_record(), analysis));
  EXPECT_TRUE(s["bed"]["packing_density"].is_null());
  s = Json::parse(summary_json(sample_scene(), sample_record(), std::nullopt));
  EXPECT_TRUE(s["bed"].contains("packing_density") && s["bed"]["packing_density"].is_null());
}

TEST(Summary, RecordComesBackAsItWas) {
  RunRecord r = sample_record();
  r.counters["unknown"] = std::numeric_limits<double>::quiet_NaN();
  const RunRecord back = record_from_json(record_json(r));
  EXPECT_EQ(record_json(back), record_json(r));
  EXPECT_EQ(back.seed, r.seed);
  EXPECT_EQ(back.time.simulated_s, r.time.simulated_s);
  EXPECT_EQ(back.audit_passed(), r.audit_passed());
  EXPECT_THROW(record_from_json("{"), InputError);
  EXPECT_THROW(record_from_json("{}"), InputError);
}

TEST(Summary, TextSaysItAllAndEndsWithTheReport) {
  const std::string text = summary_text(sample_scene(), sample_record(), sample_analysis(sample_bed()),
                                        "results/s", "results/s/report.html");
  for (const char* part : {"300 asked", "1 escaped", "0.5923", "0.31 %", "FAILED", "waited 0.4 s",
                           "find pairs 10.1 s", "voxel 0.1 mm"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in:" << text;
  EXPECT_TRUE(text.ends_with("results/s/report.html\n")) << text;
  std::size_t widest = 0;
  for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    widest = std::max(widest, end - at);
  EXPECT_LE(widest, 110u) << text;
}

}  // namespace
}  // namespace packbed
