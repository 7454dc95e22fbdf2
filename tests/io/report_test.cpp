// The report is one self-contained page that holds what it shows; tests/io/report_in_browser draws it.
#include "io/report.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "io/bed.hpp"
#include "io/sample_bed.hpp"
#include "io/temporary_folder.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

std::string written_report(const TemporaryFolder& folder, const PackedBed& bed) {
  const RunRecord record = sample_record();
  const Scene scene = sample_scene();
  write_report(folder / "report.html", bed, &record, sample_analysis(bed), &scene,
               find_references("", "A38", "LC", "poured"));
  return read_file(folder / "report.html");
}

nlohmann::json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(Report, ThreeThousandPelletsFitIntoThreeMegabytes) {
  const TemporaryFolder folder;
  EXPECT_LT(written_report(folder, sample_bed(3038)).size(), 3'000'000u);
}

TEST(Report, AsksNothingOfTheNetwork) {
  const TemporaryFolder folder;
  const std::string page = written_report(folder, sample_bed(10));
  for (const char* way :
       {"src=\"http", "href=\"http", "src='http", "@import", "url(http", "<link rel=\"stylesheet\""})
    EXPECT_EQ(page.find(way), std::string::npos) << way;
}

TEST(Report, TextOfACaseCannotBreakThePage) {
  const TemporaryFolder folder;
  PackedBed bed = sample_bed(3);
  bed.provenance.case_text = "# </script><script>alert(1)</script> @SCRIPT@ <!-- \xff";
  const std::string page = written_report(folder, bed);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(data_of(page)
                .at("provenance")
                .at("case_text")
                .get<std::string>()
                .find("</script><script>alert(1)</script> @SCRIPT@"),
            std::string::npos);
}

TEST(Report, TheHeadlineIsTheAnalysisAndTheReference) {
  const TemporaryFolder folder;
  const PackedBed bed = sample_bed(10);
  const nlohmann::json data = data_of(written_report(folder, bed));
  EXPECT_EQ(data.at("bulk").at("packing_density").get<double>(), sample_analysis(bed).bulk.packing_density);
  EXPECT_EQ(data.at("references").at(0).at("mean").get<double>(), 0.591);
  EXPECT_EQ(data.at("references").at(0).at("sd").get<double>(), 0.006);
  EXPECT_EQ(data.at("bed_hash"), bed_hash(bed));
  EXPECT_EQ(data.at("provenance").at("seed"), "18364758544493064720") << "all 64 bits";
}

TEST(Report, ABedWithoutRunOrAnalysisHasOneToo) {
  const TemporaryFolder folder;
  write_report(folder / "report.html", sample_bed(3), nullptr, {}, nullptr, {});
  EXPECT_TRUE(data_of(read_file(folder / "report.html")).at("run").is_null());
}

TEST(References, AreFoundByPelletContainerAndState) {
  const auto poured = find_references("", "a38", "LC", "poured");
  ASSERT_EQ(poured.size(), 1u);
  EXPECT_EQ(poured[0].label, "CT, poured, 4 beds");
  EXPECT_NE(poured[0].source.find("X-ray Tomography"), std::string::npos);
  EXPECT_EQ(find_references("", "a38", "lc", "tapped").at(0).mean, 0.646);
  EXPECT_TRUE(find_references("", "a38", "sc", "poured").empty());
  EXPECT_TRUE(find_references("", "pr", "column", "poured").empty()) << "not scanned: no CT value";
  EXPECT_EQ(
      find_references(PACKBED_SOURCE_DIR "/cases/reference/ct_beds.csv", "hb", "sc", "poured").at(0).mean,
      0.390);
}

TEST(References, ABadTableIsRefused) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text) {
    write_atomically(folder / "t.csv", text);
    EXPECT_THROW(find_references(folder / "t.csv", "a", "b", "c"), InputError) << text;
  };
  EXPECT_THROW(find_references(folder / "none.csv", "a", "b", "c"), InputError);
  refused("pellet,container\na,b\n");
  refused("pellet,container,state,n_ct,ct_mean,ct_sd\na,b,c\n");
  refused("pellet,container,state,n_ct,ct_mean,ct_sd\na,b,c,1,half,0.1\n");
}

/// Draws the page in a browser; every part has to be there and nothing may go wrong.
TEST(LongReport, ABrowserDrawsEveryPart) {
  const TemporaryFolder folder;
  written_report(folder, sample_bed(300));
  const std::string command = PACKBED_SOURCE_DIR "/tests/io/report_in_browser " + (folder / "report.html");
  const int code = WEXITSTATUS(std::system(command.c_str()));
  if (code == 77) GTEST_SKIP() << "chromium is not installed";
  EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace packbed
