#include "io/size_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "io/atomic_file.hpp"
#include "io/case.hpp"
#include "io/temporary_folder.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

/// A bed that the paper's law would give, shifted.
StudyBed bed(double smallest_mm, double shift = 0) {
  StudyBed b;
  b.name = "bed";
  b.audit = "passed";
  b.pellets = 100;
  b.smallest_m = smallest_mm * 1e-3;
  b.largest_m = 18.24e-3;
  b.porosity = 0.185 + 0.205 * std::pow(b.ratio(), 0.328) + shift;
  b.segregation = 0.01 * shift;
  return b;
}

std::vector<StudyBed> beds() {
  return {bed(1.76, 1e-5), bed(2.81, -1e-5), bed(5.21, 1e-5), bed(6.9), bed(10.52, -1e-5), bed(18.24)};
}

std::string summary(double smallest_m, const std::string& core) {
  return R"({"case": "set", "audit": "passed", "seed": 3, "pellets": {"inside": 42}, "bed": {"smallest_m": )" +
         std::to_string(smallest_m) + R"(, "largest_m": 0.01824, "height_m": 0.2, "core_porosity": )" + core +
         R"(, "segregation": null, "core": {"shots": 0.3, "shots_error": 1e-5}, "coordination": null},
         "time": {"cpu_s": 5, "wall_s": 6}})";
}

TEST(SizeStudy, FitsTheLawToItsBedsAndTellsItBesideThePublishedOne) {
  const Study study = make_study(beds(), {{"n", {0.328, NAN, NAN}}, {"segregation", {NAN, -0.03, 0.05}}});
  ASSERT_TRUE(study.law);
  EXPECT_NEAR(study.law->value[2], 0.328, study.law->half_width[2]);
  const std::string text = study_text(study);
  EXPECT_NE(text.find("published: 0.328"), std::string::npos) << text;
  EXPECT_NE(text.find("(-0.03 to 0.05)"), std::string::npos) << text;
}

TEST(SizeStudy, ABedWithoutACoreIsShownAndLeftOutOfTheLaw) {
  std::vector<StudyBed> some = beds();
  some.push_back(bed(8.64));
  some.back().porosity = NAN;
  EXPECT_EQ(make_study(some, {}).law->points, 6);
}

TEST(SizeStudy, TooFewBedsHaveATableAndNoLaw) {
  const Study study = make_study({bed(1.76), bed(18.24)}, {});
  EXPECT_FALSE(study.law);
  EXPECT_NE(study_text(study).find("not fitted"), std::string::npos);
}

TEST(SizeStudy, PointsThatBendOtherwiseAreFittedWithThePublishedExponent) {
  std::vector<StudyBed> straight = beds();
  for (StudyBed& b : straight) b.porosity = 0.42 + 0.035 * std::log(b.ratio());
  const Study study = make_study(straight, {{"n", {0.328, NAN, NAN}}});
  EXPECT_FALSE(study.law);
  ASSERT_TRUE(study.with_published_n);
  EXPECT_EQ(study.with_published_n->value[2], 0.328);
  EXPECT_NEAR(study.with_published_n->at(1), 0.42, 0.01);
  EXPECT_NE(study_text(study).find("with n = 0.328 as published"), std::string::npos);
  EXPECT_FALSE(make_study(straight, {}).with_published_n);
}

TEST(SizeStudy, ThePackingModelBeginsAtTheBedsOfEqualPellets) {
  std::vector<StudyBed> some = {bed(18.24, 0.01), bed(18.24, -0.01), bed(10.52)};
  some[2].sizes = {{10.52e-3, 0.14}, {18.24e-3, 0.86}};
  const Study study = make_study(some, {});
  EXPECT_NEAR(study.beds[0].model, 0.39, 1e-12);
  EXPECT_NEAR(study.beds[2].model, mixture_porosity(some[2].sizes, 0.39), 1e-12);
  EXPECT_TRUE(std::isnan(make_study({some[2]}, {}).beds[0].model));
}

TEST(SizeStudy, ReadsSummariesInTheOrderOfTheirSmallestPellets) {
  const TemporaryFolder folder;
  for (const auto& [name, size] : {std::pair("a", 0.01), {"b", 0.005}}) {
    std::filesystem::create_directories(folder / name);
    write_atomically((std::filesystem::path(folder / name) / "summary.json").string(),
                     summary(size, size > 0.007 ? "null" : "0.31"));
  }
  const auto read = read_study({folder / "a", folder / "b"});
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].porosity, 0.31);
  EXPECT_DOUBLE_EQ(read[0].ratio(), 0.005 / 0.01824);
  EXPECT_EQ(read[0].pellets, 42);
  EXPECT_TRUE(std::isnan(read[1].porosity));
  EXPECT_TRUE(std::isnan(read[0].segregation));
  write_atomically(folder / "summary.json", "{}");
  EXPECT_THROW(read_study({folder / "summary.json"}), InputError);
  EXPECT_THROW(read_study({folder / "nothing"}), InputError);
}

TEST(SizeStudy, WritesTableLawAndThreeFigures) {
  const TemporaryFolder folder;
  const auto published = read_published(PACKBED_SOURCE_DIR "/cases/wood_chips/published.csv");
  EXPECT_EQ(published.at("a").value, 0.185);
  EXPECT_TRUE(std::isnan(published.at("segregation").value));
  EXPECT_EQ(published.at("segregation").high, 0.05);
  write_study(folder / ".", make_study(beds(), published));
  const std::string page = read_file(folder / "study.html");
  std::size_t figures = 0;
  for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) ++figures;
  EXPECT_EQ(figures, 3u);
  EXPECT_EQ(page.find("nan"), std::string::npos);
  EXPECT_NE(read_file(folder / "law.csv").find("\nn,0.3"), std::string::npos);
  const std::string table = read_file(folder / "beds.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7);
}

TEST(SizeStudy, EveryBedOfTheWoodChipsHasItsCase) {
  const std::string runs = read_file(PACKBED_SOURCE_DIR "/cases/wood_chips/runs.csv");
  int full = 0;
  for (std::size_t at = runs.find("\nfull,"); at != std::string::npos; at = runs.find("\nfull,", at + 1)) {
    const std::size_t from = at + 6;
    const std::string set = runs.substr(from, runs.find(',', from) - from);
    const Scene scene = read_case(PACKBED_SOURCE_DIR "/cases/wood_chips/set_" + set + ".toml");
    EXPECT_NEAR(scene.pellets[0].asked.smallest, 1e-3 * std::stod(set), 1e-9);
    EXPECT_EQ(scene.pellets[0].sizes.front().scale, 1);
    ++full;
  }
  EXPECT_EQ(full, 38);  // as many as in the paper
}

}  // namespace
}  // namespace packbed
