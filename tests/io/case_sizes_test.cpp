// [pellet.sizes], the lattice start and scales of placed pellets in a case.
#include <gtest/gtest.h>

#include <cmath>

#include "io/case_texts.hpp"

namespace packbed {
namespace {

const std::string kSized = R"([pellet]
shape = "sphere"
diameter = "18.24 mm"
density = "500 kg/m3"
[pellet.sizes]
law = "table"
by = "number"
diameters = ["18.24 mm", "10.52 mm", "8.64 mm"]
amounts = [1785, 1526, 2869]
[container]
shape = "tube"
inner_diameter = "200 mm"
height = "2 m"
[feed]
kind = "lattice"
drop_height = "300 mm"
speed = "0.5 m/s"
[analysis]
voxel = "1 mm"
)";

const std::string kPaper = std::string("csv = \"") + PACKBED_SOURCE_DIR + "/cases/reference/wood_chips.csv\"";
const std::string kInline =
    "diameters = [\"18.24 mm\", \"10.52 mm\", \"8.64 mm\"]\namounts = [1785, 1526, 2869]";

std::uint32_t count(const Scene& s, std::size_t size) {
  return s.pellets.at(0).sizes.at(size).count;
}

TEST(CaseSizes, ATableByNumberCountsItsPellets) {
  const Scene s = read(kSized);
  EXPECT_EQ(s.feed.kind, FeedKind::lattice);
  EXPECT_EQ(s.feed.count, 1785 + 1526 + 2869);
  ASSERT_EQ(s.pellets[0].sizes.size(), 3u);
  EXPECT_EQ(count(s, 1), 1526u);
  EXPECT_DOUBLE_EQ(s.pellets[0].sizes[2].scale, 8.64 / 18.24);
  EXPECT_DOUBLE_EQ(s.pellets[0].sizes[2].asked, 2869.0 / (1785 + 1526 + 2869));
}

TEST(CaseSizes, ACountScalesTheTableDown) {
  const Scene s = read(kSized, {"feed.count=618"});
  EXPECT_EQ(count(s, 0) + count(s, 1) + count(s, 2), 618u);
  EXPECT_NEAR(count(s, 0), 178.5, 0.51);
  EXPECT_NEAR(count(s, 2), 286.9, 0.51);
}

TEST(CaseSizes, AMassDecidesHowMany) {
  const double ball = 500 * kPi / 6 * std::pow(18.24e-3, 3);
  const double mean = ball * (1785 + 1526 * std::pow(10.52 / 18.24, 3) + 2869 * std::pow(8.64 / 18.24, 3)) /
                      (1785 + 1526 + 2869);
  const Scene s = read(kSized, {"feed.mass=1 kg"});
  EXPECT_EQ(s.feed.count, std::lround(1 / mean));
  EXPECT_FALSE(s.feed.mass);
}

TEST(CaseSizes, ThePapersTableIsReadFromItsFileAndCutAtASize) {
  const Scene s = read(replaced(kSized, kInline, kPaper), {"pellet.sizes.smallest=8.64 mm"});
  EXPECT_EQ(s.feed.count, 1785 + 1526 + 2869);
  const Scene all = read(replaced(kSized, kInline, kPaper), {"pellet.sizes.smallest=1.76 mm"});
  ASSERT_EQ(all.pellets[0].sizes.size(), 7u);
  EXPECT_EQ(all.feed.count, 123444);
  const Scene by_volume =
      read(replaced(kSized, kInline, kPaper),
           {"pellet.sizes.smallest=8.64 mm", "pellet.sizes.by=volume", "feed.count=6180"});
  EXPECT_NEAR(count(by_volume, 2), 2869, 0.01 * 2869);  // the paper's volumes have three digits
}

TEST(CaseSizes, FractionsTakeThePlaceOfAmounts) {
  const Scene s = read(kSized, {"pellet.sizes.fractions=[0.5, 0.3, 0.2]", "feed.count=10"});
  EXPECT_EQ(count(s, 0), 5u);
  EXPECT_EQ(count(s, 2), 2u);
}

TEST(CaseSizes, LawsGiveAsManySizesAsPellets) {
  const std::string table = "law = \"table\"\nby = \"number\"\n" + kInline;
  const std::string rosin =
      "law = \"rosin_rammler\"\nmodulus = \"10 mm\"\nexponent = 2\nsmallest = \"5 mm\"\nlargest = \"18 mm\"";
  const Scene s = read(replaced(kSized, table, rosin), {"feed.count=500"});
  ASSERT_EQ(s.pellets[0].sizes.size(), 500u);
  EXPECT_GE(s.pellets[0].sizes.back().scale * 18.24e-3, 5e-3);
  const std::string gates =
      "law = \"gates_gaudin_schuhmann\"\nmodulus = \"16 mm\"\nexponent = 2\nsmallest = \"5 mm\"";
  EXPECT_LE(
      read(replaced(kSized, table, gates), {"feed.count=500"}).pellets[0].sizes.front().scale * 18.24e-3,
      16e-3);
  const std::string normal =
      "law = \"log_normal\"\nmodulus = \"10 mm\"\ndeviation = 1.3\nsmallest = \"5 mm\"\nlargest = \"18 mm\"";
  EXPECT_EQ(read(replaced(kSized, table, normal), {"feed.count=9"}).pellets[0].sizes.size(), 9u);
}

TEST(CaseSizes, OneKindWithSizesMakesAllKindsExact) {
  const std::string two = replaced(kSized, "[pellet]", "[[pellet]]\nshare = 3");
  const Scene s = read(replaced(two, "[container]",
                                "[[pellet]]\nshape = \"sphere\"\ndiameter = \"9 mm\"\ndensity = \"1 g/cm3\"\n"
                                "[container]"),
                       {"feed.count=1001"});
  EXPECT_EQ(count(s, 0) + count(s, 1) + count(s, 2), 751u);
  ASSERT_EQ(s.pellets[1].sizes.size(), 1u);
  EXPECT_EQ(s.pellets[1].sizes[0].count, 250u);
}

TEST(CaseSizes, DefaultsReadBackToTheSameSizes) {
  const Scene a = read(replaced(kSized, kInline, kPaper), {"feed.count=777", "analysis.voxel=0.2 mm"});
  const Scene b = read_case_text(a.case_text, "somewhere/else.toml");
  EXPECT_EQ(a.case_text, b.case_text);
  ASSERT_EQ(a.pellets[0].sizes.size(), b.pellets[0].sizes.size());
  for (std::size_t i = 0; i < a.pellets[0].sizes.size(); ++i)
    EXPECT_EQ(a.pellets[0].sizes[i].count, b.pellets[0].sizes[i].count);
}

TEST(CaseSizes, BadSizesAreRefusedForAReason) {
  const auto said = [](const std::string& from, const std::string& to) {
    return refusal(replaced(kSized, from, to), {"feed.count=100"});
  };
  const std::string amounts = "amounts = [1785, 1526, 2869]";
  EXPECT_NE(said(amounts, "fractions = [0.5, 0.3, 0.1]").find("add up to 0.9"), std::string::npos);
  EXPECT_NE(said(amounts, "amounts = [1, 2]").find("3 diameters and 2"), std::string::npos);
  EXPECT_NE(said(amounts, "amounts = [0, 0, 0]").find("nothing between"), std::string::npos);
  EXPECT_NE(said(amounts, "amounts = [1, -2, 3]").find("amounts"), std::string::npos);
  EXPECT_NE(said(amounts, amounts + "\nsmallest = \"19 mm\"").find("nothing between"), std::string::npos);
  EXPECT_NE(said(amounts, amounts + "\nfractions = [1, 0, 0]").find("not both"), std::string::npos);
  EXPECT_NE(said(kInline, "csv = \"nowhere.csv\"").find("a file that is there"), std::string::npos);
  EXPECT_NE(said("\"18.24 mm\", \"10.52 mm\", \"8.64 mm\"", "\"18.24 mm\", 10.52, \"8.64 mm\"").find("unit"),
            std::string::npos);
  EXPECT_NE(said("\"10.52 mm\"", "\"210 mm\"").find("container's inner diameter"), std::string::npos);
  EXPECT_NE(said("law = \"table\"", "law = \"rosin_rammler\"").find("this key only with"), std::string::npos);
  const std::string bare = "law = \"log_normal\"\nmodulus = \"9 mm\"\ndeviation = 1.2";
  EXPECT_NE(said("law = \"table\"\nby = \"number\"\n" + kInline, bare).find("no smallest"),
            std::string::npos);
  EXPECT_NE(said("kind = \"lattice\"", "kind = \"lattice\"\nheight = \"1 m\"").find("only with"),
            std::string::npos);
  EXPECT_NE(refusal(kSized, {"method=digipac"}).find("far above the container"), std::string::npos);
  EXPECT_NE(refusal(replaced(kSized, "by = \"number\"", "by = \"volume\"")).find("no end of feeding"),
            std::string::npos);
}

class SizeTable : public CaseFiles {
 protected:
  std::string message_of(const std::string& table, const std::string& by = "number") {
    write("sizes.csv", table);
    return message(write("bed.toml", replaced(replaced(kSized, kInline, "csv = \"sizes.csv\""),
                                              "by = \"number\"", "by = \"" + by + "\"")));
  }
};

TEST_F(SizeTable, ReadsAmountsAndFractionsByTheirName) {
  EXPECT_EQ(message_of("# sieves\nsieve,diameter_cm,count\nbig,1.8,10\nsmall,0.9,20\n"), "");
  EXPECT_EQ(message_of("diameter_mm,number_fraction\n18,0.25\n9,0.75\n"), "");
}

TEST_F(SizeTable, IsRefusedForAReason) {
  EXPECT_NE(message_of("diameter,count\n18,1\n").find("with a unit"), std::string::npos);
  EXPECT_NE(message_of("diameter_mm,volume\n18,1\n").find("count or number_fraction"), std::string::npos);
  EXPECT_NE(message_of("diameter_mm,number_fraction\n18,0.5\n9,0.4\n").find("add up to 0.9"),
            std::string::npos);
  EXPECT_NE(message_of("diameter_mm,count\n18\n").find("sizes.csv:2"), std::string::npos);
  EXPECT_NE(message_of("diameter_mm,count\n18,many\n").find("a finite number"), std::string::npos);
  EXPECT_NE(message_of("diameter_mm,count\n-18,3\n").find("greater than 0"), std::string::npos);
  EXPECT_NE(message_of("diameter_mm,count\n").find("no sizes"), std::string::npos);
}

TEST(CaseSizes, PlacedPelletsHaveTheirOwnScale) {
  EXPECT_EQ(read(kPlaced, {"feed.placed.1.scale=0.5"}).feed.placed[1].scale, 0.5);
  EXPECT_NE(refusal(kPlaced, {"feed.placed.1.scale=0"}).find("scale"), std::string::npos);
}

}  // namespace
}  // namespace packbed
