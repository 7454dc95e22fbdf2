#include "io/case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "contact/damping.hpp"
#include "io/case_reader.hpp"
#include "math/error.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

const std::string kCase = R"([pellet]
shape = "cylinder"
diameter = "3.42 mm"
height = "3.46 mm"
density = "2.41 g/cm3"
[container]
shape = "tube"
inner_diameter = "44.5 mm"
height = "150 mm"
[contact]
friction = 0.6
damping = 0.4
[feed]
kind = "layers"
count = 300
per_layer = 49
interval = "40 ms"
drop_height = "135 mm"
)";

const std::string kPlaced = R"([pellet]
shape = "sphere"
diameter = "4 mm"
density = "2500 kg/m3"
[container]
shape = "plane"
[feed]
kind = "placed"
[[feed.placed]]
position = ["0 mm", "1 mm", "10 mm"]
velocity = ["0 m/s", "0 m/s", "-1 m/s"]
spin = ["0 rad/s", "60 rpm", "0 rad/s"]
[[feed.placed]]
position = ["20 mm", "0 mm", "2 mm"]
turn = "90 deg"
turn_about = [0, 2, 0]
fixed = true
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

Scene read(const std::string& text, const std::vector<std::string>& sets = {}) {
  return read_case_text(text, "bed.toml", sets);
}

/// The message with which a text is refused; empty when it is read.
std::string refusal(const std::string& text, const std::vector<std::string>& sets = {}) {
  try {
    read(text, sets);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// kCase with one line changed must be refused with all of these words.
void expect_refused(const std::string& from, const std::string& to, const std::vector<std::string>& words) {
  const std::string message = refusal(replaced(kCase, from, to));
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in: " << message;
}

/// An empty folder of its own for the test that runs.
class CaseFiles : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / fs::path(std::string("packbed_case_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "sub");
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string message(const std::string& path) const {
    try {
      read_case(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  fs::path folder_;
};

// --- what a good case gives ------------------------------------------------------------------------------

TEST(Case, ValuesArriveInSI) {
  const Scene s = read(kCase);
  ASSERT_EQ(s.pellets.size(), 1u);
  EXPECT_EQ(s.pellets[0].density, 2410);
  EXPECT_EQ(s.pellets[0].share, 1);
  EXPECT_EQ(s.pellets[0].shape->kind, ShapeClass::cylinder);
  EXPECT_DOUBLE_EQ(s.pellets[0].shape->radius, 0.00171);
  EXPECT_EQ(s.container.kind, ContainerKind::tube);
  EXPECT_DOUBLE_EQ(s.container.radius, 0.02225);
  EXPECT_EQ(s.container.height, 0.15);
  EXPECT_EQ(s.feed.kind, FeedKind::layers);
  EXPECT_EQ(s.feed.count, 300);
  EXPECT_EQ(s.feed.per_layer, 49);
  EXPECT_EQ(s.feed.interval, 0.04);
  EXPECT_EQ(s.feed.drop_height, 0.135);
  EXPECT_EQ(s.pellet_contact.friction, 0.6);
  EXPECT_EQ(s.pellet_contact.damping_ratio, 0.4);
  EXPECT_EQ(s.gravity, Vec3(0, 0, -9.80665));
  EXPECT_EQ(s.name, "bed");
  EXPECT_EQ(s.seed, 1u);
}

TEST(Case, DefaultsOfTheRecordsHold) {
  const Scene s = read(kCase), fresh;
  EXPECT_EQ(s.stepping.step, fresh.stepping.step);
  EXPECT_EQ(s.stepping.sleep, fresh.stepping.sleep);
  EXPECT_EQ(s.stepping.rest_speed, fresh.stepping.rest_speed);
  EXPECT_EQ(s.analysis.voxel, fresh.analysis.voxel);
  EXPECT_EQ(s.output.checkpoint_interval, fresh.output.checkpoint_interval);
  EXPECT_EQ(s.overlap_limit, fresh.overlap_limit);
}

TEST(Case, WallFollowsThePelletsUnlessToldOtherwise) {
  EXPECT_EQ(read(kCase).wall_contact.friction, 0.6);
  EXPECT_EQ(read(kCase).wall_contact.damping_ratio, 0.4);
  const Scene s =
      read(replaced(kCase, "[feed]", "[contact.wall]\nrestitution = 0.5\ntorsion = false\n[feed]"));
  EXPECT_EQ(s.wall_contact.friction, 0.6);
  EXPECT_FALSE(s.wall_contact.torsion);
  EXPECT_TRUE(s.pellet_contact.torsion);
  EXPECT_EQ(s.pellet_contact.damping_ratio, 0.4);
  EXPECT_NEAR(restitution_from_damping(s.wall_contact.damping_ratio), 0.5, 1e-12);
}

TEST(Case, StiffnessTakesThePlaceOfTheAllowedOverlap) {
  const Scene s = read(replaced(kCase, "damping = 0.4", "stiffness = \"10 kN/m\""));
  EXPECT_EQ(s.pellet_contact.stiffness, 1e4);
  EXPECT_EQ(s.pellet_contact.allowed_overlap, 0);
  EXPECT_EQ(read(kCase).pellet_contact.stiffness, 0);
  EXPECT_GT(read(kCase).pellet_contact.allowed_overlap, 0);
}

TEST(Case, SharesOfKindsAddUpToOne) {
  const std::string two = replaced(kCase, "[pellet]", "[[pellet]]\nshare = 3");
  const Scene s = read(
      replaced(two, "[container]",
               "[[pellet]]\nshape = \"sphere\"\ndiameter = \"2 mm\"\ndensity = \"1 g/cm3\"\n[container]"));
  ASSERT_EQ(s.pellets.size(), 2u);
  EXPECT_DOUBLE_EQ(s.pellets[0].share, 0.75);
  EXPECT_DOUBLE_EQ(s.pellets[1].share, 0.25);
  EXPECT_EQ(s.pellets[1].shape->kind, ShapeClass::sphere);
}

TEST(Case, PlacedPelletsKeepPoseVelocityAndSpin) {
  const Scene s = read(kPlaced);
  ASSERT_EQ(s.feed.placed.size(), 2u);
  EXPECT_EQ(s.feed.placed[0].pose.position, Vec3(0, 0.001, 0.01));
  EXPECT_EQ(s.feed.placed[0].velocity, Vec3(0, 0, -1));
  EXPECT_DOUBLE_EQ(s.feed.placed[0].spin.y(), 2 * kPi);
  EXPECT_FALSE(s.feed.placed[0].fixed);
  EXPECT_TRUE(s.feed.placed[1].fixed);
  // a quarter turn about y takes z to x
  EXPECT_NEAR((s.feed.placed[1].pose.rotation * Vec3::UnitZ() - Vec3::UnitX()).norm(), 0, 1e-15);
}

TEST(Case, GravityPointsDownOrAnyWay) {
  EXPECT_EQ(read("gravity = \"10 m/s2\"\n" + kCase).gravity, Vec3(0, 0, -10));
  EXPECT_EQ(read("gravity = [\"1 m/s2\", \"0 m/s2\", \"-2 m/s2\"]\n" + kCase).gravity, Vec3(1, 0, -2));
}

// --- the case with its defaults --------------------------------------------------------------------------

TEST(Case, DefaultsReadBackToTheSameScene) {
  const std::string rich =
      replaced(kCase, "[feed]",
               "[contact.wall]\nrestitution = 0.333\nstiffness = \"12.7 N/mm\"\n[stepping]\nstep = \"3 us\"\n"
               "[output]\ntrajectory_interval = \"1.7 ms\"\n[feed]\nmass = \"3 g\"\nradius = \"0.5 in\"");
  for (const std::string& text : {kCase, kPlaced, "seed = \"18446744073709551615\"\n" + rich}) {
    const Scene a = read(text);
    const Scene b = read_case_text(a.case_text, "somewhere/else.toml");
    EXPECT_EQ(a.case_text, b.case_text);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.gravity, b.gravity);
    EXPECT_EQ(a.wall_contact.damping_ratio, b.wall_contact.damping_ratio);
    EXPECT_EQ(a.wall_contact.stiffness, b.wall_contact.stiffness);
    EXPECT_EQ(a.wall_contact.allowed_overlap, b.wall_contact.allowed_overlap);
    EXPECT_EQ(a.feed.radius, b.feed.radius);
    EXPECT_EQ(a.feed.mass, b.feed.mass);
    EXPECT_EQ(a.stepping.step, b.stepping.step);
    EXPECT_EQ(a.output.trajectory_interval, b.output.trajectory_interval);
    ASSERT_EQ(a.feed.placed.size(), b.feed.placed.size());
    for (std::size_t i = 0; i < a.feed.placed.size(); ++i) {
      EXPECT_EQ(a.feed.placed[i].pose.rotation.coeffs(), b.feed.placed[i].pose.rotation.coeffs());
      EXPECT_EQ(a.feed.placed[i].spin, b.feed.placed[i].spin);
    }
  }
}

TEST(Case, DefaultsSayUnitAndRange) {
  const std::string text = read(kCase).case_text;
  EXPECT_NE(text.find("interval = \"40 ms\""), std::string::npos);
  EXPECT_NE(text.find("between two layers or handfuls [s]; > 0 s and <= 3600 s"), std::string::npos) << text;
  EXPECT_NE(text.find("step = \"auto\""), std::string::npos);
  EXPECT_NE(text.find("# mass is not given"), std::string::npos);
}

TEST(Case, EveryKeyIsInTheDocumentation) {
  std::ifstream file(PACKBED_SOURCE_DIR "/docs/case.md");
  const std::string docs((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(docs.find(case_keys_as_markdown()), std::string::npos)
      << "the tables of docs/case.md should be:\n"
      << case_keys_as_markdown();
}

// --- --set and extends -----------------------------------------------------------------------------------

TEST(Case, SetChangesAKeyWithAndWithoutQuotes) {
  const Scene s = read(kCase, {"contact.friction=0.9", "pellet.density=2.5 g/cm3", "feed.interval=\"20 ms\"",
                               "name=other", "feed.radius = 10 mm", "container.height=200mm"});
  EXPECT_EQ(s.pellet_contact.friction, 0.9);
  EXPECT_EQ(s.wall_contact.friction, 0.9);
  EXPECT_EQ(s.pellets[0].density, 2500);
  EXPECT_EQ(s.feed.interval, 0.02);
  EXPECT_EQ(s.feed.radius, 0.01);
  EXPECT_EQ(s.container.height, 0.2);
  EXPECT_EQ(s.name, "other");
}

TEST(Case, SetTakesThePlaceOfTheAlternativeKey) {
  EXPECT_NEAR(read(kCase, {"contact.restitution=0.45"}).pellet_contact.damping_ratio,
              damping_from_restitution(0.45), 1e-15);
  const Scene s = read(kCase, {"pellet.diameter=5 mm", "pellet.shape=sphere"});
  EXPECT_EQ(s.pellets[0].shape->kind, ShapeClass::sphere);
  EXPECT_DOUBLE_EQ(s.pellets[0].shape->radius, 0.0025);
}

TEST(Case, SetReachesElementsOfLists) {
  const Scene s =
      read(kPlaced, {"feed.placed.1.fixed=false", "feed.placed.0.position=[\"1 mm\", \"0 mm\", \"3 mm\"]"});
  EXPECT_FALSE(s.feed.placed[1].fixed);
  EXPECT_EQ(s.feed.placed[0].pose.position, Vec3(0.001, 0, 0.003));
}

TEST(Case, WrongSetNamesItself) {
  EXPECT_NE(refusal(kCase, {"contact.frction=0.9"}).find("--set contact.frction=0.9: contact.frction"),
            std::string::npos);
  EXPECT_NE(refusal(kCase, {"contact.friction"}).find("no \"=\""), std::string::npos);
  EXPECT_NE(refusal(kCase, {"=3"}).find("an empty key"), std::string::npos);
  EXPECT_NE(refusal(kCase, {"feed..count=3"}).find("an empty key"), std::string::npos);
  EXPECT_NE(refusal(kCase, {"contact.damping=0.3", "contact.restitution=0.3"}).find("not both"),
            std::string::npos);
}

TEST_F(CaseFiles, SeedOfTheCommandLineOverrules) {
  const std::string path = write("bed.toml", "seed = 5\n" + kCase);
  EXPECT_EQ(read_case(path).seed, 5u);
  EXPECT_EQ(read_case(path, {}, 7).seed, 7u);
  EXPECT_EQ(read_case(path, {"seed=8"}).seed, 8u);
}

TEST_F(CaseFiles, ExtendedCaseIsChangedKeyByKeyAndKeepsItsFiles) {
  write("pellets.csv", "x_mm,y_mm,z_mm\n0,0,10\n");
  write("base.toml", "name = \"base\"\n" + replaced(kPlaced, kPlaced.substr(kPlaced.find("[[feed")),
                                                    "csv = \"pellets.csv\"\n[contact]\nfriction = 0.3\n"));
  const std::string path =
      write("sub/corner.toml", "extends = \"../base.toml\"\n[contact]\nrestitution = 0.9\n");
  const Scene s = read_case(path);
  EXPECT_EQ(s.name, "corner");
  EXPECT_EQ(s.pellet_contact.friction, 0.3);
  EXPECT_NEAR(restitution_from_damping(s.pellet_contact.damping_ratio), 0.9, 1e-12);
  ASSERT_EQ(s.feed.placed.size(), 1u);
  EXPECT_NE(s.case_text.find("csv = \"../pellets.csv\""), std::string::npos);
  EXPECT_EQ(read_case_text(s.case_text, "anywhere/x.toml").case_text, s.case_text);
}

TEST_F(CaseFiles, MistakeInTheExtendedCaseNamesThatFile) {
  write("base.toml", replaced(kCase, "friction = 0.6", "friction = -1"));
  const std::string said = message(write("top.toml", "extends = \"base.toml\"\n"));
  EXPECT_NE(said.find("base.toml:11: contact.friction"), std::string::npos) << said;
}

TEST_F(CaseFiles, ExtendsInACircleIsRefused) {
  write("a.toml", "extends = \"b.toml\"\n");
  EXPECT_NE(message(write("b.toml", "extends = \"a.toml\"\n")).find("extend each other"), std::string::npos);
}

TEST_F(CaseFiles, ExtendsOfNothingIsRefused) {
  const std::string said = message(write("a.toml", "\nextends = \"none.toml\"\n"));
  EXPECT_NE(said.find("a.toml:2: extends"), std::string::npos) << said;
  EXPECT_NE(said.find("no such file"), std::string::npos) << said;
}

// --- one reason each -------------------------------------------------------------------------------------

TEST_F(CaseFiles, MissingFileIsRefused) {
  EXPECT_NE(message((folder_ / "no.toml").string()).find("no such file"), std::string::npos);
  EXPECT_NE(message(folder_.string()).find("not a file"), std::string::npos);
}

TEST(CaseRefuses, TextThatIsNotToml) {
  expect_refused("friction = 0.6", "friction = = 0.6", {"bed.toml:11:12", "not TOML"});
  EXPECT_NE(refusal(kCase + "\"").find("not TOML"), std::string::npos);
  // toml++ 3.3 asserts on these when it is used as headers only, without NDEBUG: it has to be the compiled
  // library
  for (const char* header : {"[{a]", "[[[a]]]", "[=", "[[="})
    EXPECT_NE(refusal(header).find("not TOML"), std::string::npos) << header;
}

TEST(CaseRefuses, UnknownKeyAndNamesTheNearest) {
  expect_refused("friction = 0.6", "fricton = 0.6",
                 {"bed.toml:11: contact.fricton", "unknown key", "\"friction\""});
  expect_refused("per_layer", "perlayer", {"bed.toml:16: feed.perlayer", "\"per_layer\""});
  expect_refused("[contact]", "[contatc]", {"bed.toml:10: contatc", "\"contact\""});
}

TEST(CaseRefuses, KeyInTheWrongSectionAndNamesTheRightOne) {
  expect_refused("damping = 0.4", "count = 3",
                 {"bed.toml:12: contact.count", "\"count\" is a key of [feed]"});
}

TEST(CaseRefuses, BareNumberWhereAUnitIsNeeded) {
  expect_refused("\"3.42 mm\"", "3.42",
                 {"bed.toml:3: pellet.diameter", "found 3.42", "m, cm, mm, um, nm, in", "\"3.42 mm\""});
  expect_refused("\"40 ms\"", "1", {"bed.toml:17: feed.interval", "s, ms, us, min, h"});
}

TEST(CaseRefuses, UnitMissingOrWrong) {
  expect_refused("3.42 mm", "3.42", {"bed.toml:3: pellet.diameter", "m, cm, mm"});
  expect_refused("3.42 mm", "3.42 kg", {"pellet.diameter", "\"kg\" is not a unit of length"});
  expect_refused("3.42 mm", "3,42 mm", {"pellet.diameter", "\",42 mm\" is not a unit"});
}

TEST(CaseRefuses, NumbersThatAreNotFinite) {
  expect_refused("friction = 0.6", "friction = nan",
                 {"bed.toml:11: contact.friction", "found nan", "finite"});
  expect_refused("friction = 0.6", "friction = inf", {"contact.friction", "found inf"});
  expect_refused("3.42 mm", "nan mm", {"pellet.diameter", "\"nan mm\""});
}

TEST(CaseRefuses, DensityNotAboveZero) {
  expect_refused("2.41 g/cm3", "0 g/cm3",
                 {"bed.toml:5: pellet.density", "\"0 g/cm3\"", "> 0 kg/m3", "without mass"});
  expect_refused("2.41 g/cm3", "-2 g/cm3", {"bed.toml:5: pellet.density", "\"-2 g/cm3\"", "> 0 kg/m3"});
}

TEST(CaseRefuses, DensityNotGiven) {
  expect_refused("density = \"2.41 g/cm3\"\n", "", {"bed.toml:1: pellet.density", "found nothing", "g/cm3"});
}

TEST(CaseRefuses, NegativeFriction) {
  expect_refused("friction = 0.6", "friction = -0.1",
                 {"bed.toml:11: contact.friction", "found -0.1", "0 to 10", "never pulls"});
}

TEST(CaseRefuses, StepNotAboveZero) {
  for (const char* step : {"0 s", "-5 us"})
    expect_refused("[feed]", "[stepping]\nstep = \"" + std::string(step) + "\"\n[feed]",
                   {"bed.toml:14: stepping.step", step, "> 0 s", "time has to go on"});
}

TEST(CaseRefuses, DampingOutsideItsRange) {
  expect_refused("damping = 0.4", "damping = 1.2", {"contact.damping", "0 to 1", "critical"});
  expect_refused("damping = 0.4", "damping = -0.1", {"contact.damping", "0 to 1"});
  expect_refused("damping = 0.4", "restitution = 0.1", {"contact.restitution", "0.1353"});
  expect_refused("damping = 0.4", "restitution = 1.01", {"contact.restitution", "to 1"});
}

TEST(CaseRefuses, TwoKeysThatSayTheSameThing) {
  expect_refused("damping = 0.4", "damping = 0.4\nrestitution = 0.5",
                 {"contact.restitution", "one of damping, restitution, not both"});
  expect_refused("damping = 0.4", "stiffness = \"1 kN/m\"\nallowed_overlap = 0.02",
                 {"contact.allowed_overlap", "not both"});
}

TEST(CaseRefuses, NothingToFeed) {
  expect_refused("per_layer = 49", "per_layer = 0", {"bed.toml:16: feed.per_layer", "found 0", "1 to"});
  expect_refused("count = 300", "count = 0", {"bed.toml:15: feed.count", "found 0"});
  expect_refused("count = 300", "count = -3", {"feed.count", "found -3"});
  expect_refused("count = 300", "count = 12.5", {"feed.count", "found 12.5", "whole number"});
  expect_refused("count = 300\n", "", {"feed: found no end of feeding", "count, height or mass"});
}

TEST(CaseRefuses, IntervalNotAboveZero) {
  expect_refused("40 ms", "0 ms", {"bed.toml:17: feed.interval", "> 0 s"});
}

TEST(CaseRefuses, PelletLargerThanTheContainer) {
  expect_refused("44.5 mm", "3 mm",
                 {"pellet", "3.42 mm thick", "inner diameter, 3 mm", "larger than the container"});
}

TEST(CaseRefuses, PelletThatDoesNotEnterInEveryRotation) {
  const double across = std::hypot(3.42, 3.46);  // 4.865 mm
  ASSERT_GT(across, 4.8);
  expect_refused("44.5 mm", "4.8 mm", {"pellet", "4.865 mm across", "every rotation"});
  EXPECT_EQ(refusal(replaced(kCase, "44.5 mm", "4.9 mm")), "");
}

TEST(CaseRefuses, EntryInsideTheFloor) {
  expect_refused("135 mm", "2 mm", {"feed.drop_height", "2.432 mm", "inside the floor"});
}

TEST(CaseRefuses, EntryOutsideTheContainer) {
  expect_refused("count = 300", "count = 300\nradius = \"23 mm\"", {"feed.radius", "at most 19.82 mm"});
}

TEST(CaseRefuses, BedHigherThanTheRim) {
  expect_refused("count = 300", "height = \"160 mm\"", {"feed.height", "150 mm", "rim"});
}

TEST(CaseRefuses, ContainersThatCannotBePouredInto) {
  const std::string tube =
      kCase.substr(kCase.find("shape = \"tube\""), kCase.find("[contact]") - kCase.find("shape = \"tube\""));
  expect_refused(tube, "shape = \"none\"\n", {"container.shape", "a floor"});
  expect_refused(tube, "shape = \"plane\"\n", {"feed.radius", "no wall"});
}

TEST(CaseRefuses, PouringWithoutGravity) {
  EXPECT_NE(refusal("gravity = \"0 m/s2\"\n" + kCase).find("nothing falls"), std::string::npos);
}

TEST(CaseRefuses, WrongWordOfAList) {
  expect_refused("\"layers\"", "\"layer\"",
                 {"bed.toml:14: feed.kind", "\"layers\", \"pour\", \"placed\"", "did you mean \"layers\"?"});
  expect_refused("\"tube\"", "3", {"container.shape", "found 3"});
  EXPECT_NE(refusal("method = \"digipac\"\n" + kCase).find("\"mesh\""), std::string::npos);
}

TEST(CaseRefuses, KeyThatHasNoMeaningHere) {
  expect_refused("shape = \"cylinder\"", "shape = \"sphere\"",
                 {"bed.toml:4: pellet.height", "only with shape = \"cylinder\""});
  expect_refused("kind = \"layers\"", "kind = \"placed\"",
                 {"feed.count", "only with kind = \"layers\" or \"pour\""});
}

TEST(CaseRefuses, ShapeOrFileNotGiven) {
  expect_refused("shape = \"cylinder\"\n", "",
                 {"bed.toml:1: pellet.shape", "found nothing", "\"sphere\", \"cylinder\""});
}

TEST(CaseRefuses, FileThatIsNotThere) {
  expect_refused(kCase.substr(9, kCase.find("density") - 9), "file = \"no/pellet.step\"\n",
                 {"bed.toml:2: pellet.file", "\"no/pellet.step\"", "a file that is there"});
}

TEST(CaseRefuses, WrongKernelForTheShape) {
  EXPECT_NE(refusal("kernel = \"sphere\"\n" + kCase).find("pellet is a cylinder"), std::string::npos);
  EXPECT_EQ(refusal("kernel = \"cylinder\"\n" + kCase), "");
}

TEST(CaseRefuses, VoxelsThatMissThePellet) {
  expect_refused("[feed]", "[analysis]\nvoxel = \"4 mm\"\n[feed]", {"analysis.voxel", "3.42 mm"});
}

TEST(CaseRefuses, MiddleSectionUpsideDown) {
  expect_refused("[feed]", "[analysis]\nfrom_diameters = 9\nto_diameters = 5\n[feed]",
                 {"analysis.to_diameters", "more than from_diameters, 9"});
}

TEST(CaseRefuses, SeedThatIsNoSeed) {
  for (const char* seed : {"-1", "1.5", "\"x\"", "\"18446744073709551616\"", "true"})
    EXPECT_NE(refusal("seed = " + std::string(seed) + "\n" + kCase).find("bed.toml:1: seed"),
              std::string::npos)
        << seed;
}

TEST(CaseRefuses, ValueWhereATableBelongs) {
  EXPECT_NE(refusal("contact = 3\n").find("write [contact]"), std::string::npos);
  EXPECT_NE(refusal("pellet = []\n").find("at least one table"), std::string::npos);
  EXPECT_NE(refusal("pellet = [1]\n").find("[[pellet]]"), std::string::npos);
}

TEST(CaseRefuses, FlagThatIsNeitherTrueNorFalse) {
  expect_refused("damping = 0.4", "torsion = \"yes\"", {"contact.torsion", "true or false"});
}

TEST(CaseRefuses, PlacedPelletsThatMakeNoSense) {
  const auto said = [](const char* from, const char* to) { return refusal(replaced(kPlaced, from, to)); };
  EXPECT_NE(said("[\"0 mm\", \"1 mm\", \"10 mm\"]", "[\"0 mm\", \"1 mm\"]").find("feed.placed[0].position"),
            std::string::npos);
  EXPECT_NE(said("[\"0 mm\", \"1 mm\", \"10 mm\"]", "[0, 1, 10]").find("m, cm, mm"), std::string::npos);
  EXPECT_NE(said("fixed = true", "kind = 1").find("feed.placed[1].kind"), std::string::npos);
  EXPECT_NE(said("[0, 2, 0]", "[0, 0, 0]").find("not all zero"), std::string::npos);
  EXPECT_NE(said("fixed = true", "rotation = [1, 0, 0, 0]").find("only with no turn"), std::string::npos);
  EXPECT_NE(said("spin =", "rotation = [0, 0, 0, 0]\nspin =").find("not all zero"), std::string::npos);
  EXPECT_NE(refusal(kPlaced.substr(0, kPlaced.find("[[feed"))).find("no placed pellets"), std::string::npos);
}

TEST(CaseRefuses, EveryMistakeAtOnce) {
  std::string text = replaced(kCase, "friction = 0.6", "friction = -1");
  text = replaced(text, "\"3.42 mm\"", "3.42");
  text = replaced(text, "count = 300", "count = 0");
  const std::string message = refusal(text);
  EXPECT_NE(message.find("bed.toml: 3 problems"), std::string::npos) << message;
  for (const char* key : {"contact.friction", "pellet.diameter", "feed.count"})
    EXPECT_NE(message.find(key), std::string::npos) << key;
}

// --- files of units and tables ---------------------------------------------------------------------------

TEST_F(CaseFiles, MeshFileWithoutUnitIsRefused) {
  write("pellet.stl", "solid\nendsolid\n");
  write("pellet.step", "ISO-10303-21;\n");
  const std::string rest = kCase.substr(kCase.find("density"));
  std::string said = message(write("a.toml", "[pellet]\nfile = \"pellet.stl\"\n" + rest));
  EXPECT_NE(said.find("pellet.unit: found nothing, and pellet.stl carries no unit"), std::string::npos)
      << said;
  said = message(write("b.toml", "[pellet]\nfile = \"pellet.step\"\nunit = \"mm\"\n" + rest));
  EXPECT_NE(said.find("pellet.unit: found \"mm\" for pellet.step"), std::string::npos) << said;
  said = message(write("c.toml", "[pellet]\nfile = \"pellet.stl\"\nunit = \"parsec\"\n" + rest));
  EXPECT_NE(said.find("c.toml:3: pellet.unit"), std::string::npos) << said;
}

class PlacedTable : public CaseFiles {
 protected:
  std::string with(const std::string& table) {
    write("pellets.csv", table);
    return write("bed.toml", kPlaced.substr(0, kPlaced.find("[[feed")) + "csv = \"pellets.csv\"\n");
  }
};

TEST_F(PlacedTable, IsReadWithItsUnits) {
  const Scene s =
      read_case(with("# two pellets\nx_mm, y_m, z_cm, vx_mm/s, wz_rpm, qw, qx, qy, qz, fixed\n"
                     "1,0.002,3,40,60,2,0,0,0,0\n-1.5,0,2,0,0,0,0,0,1,1\n"));
  ASSERT_EQ(s.feed.placed.size(), 2u);
  EXPECT_EQ(s.feed.placed[0].pose.position, Vec3(0.001, 0.002, 0.03));
  EXPECT_EQ(s.feed.placed[0].velocity, Vec3(0.04, 0, 0));
  EXPECT_DOUBLE_EQ(s.feed.placed[0].spin.z(), 2 * kPi);
  EXPECT_EQ(s.feed.placed[0].pose.rotation.w(), 1);
  EXPECT_EQ(s.feed.placed[1].pose.rotation.z(), 1);
  EXPECT_TRUE(s.feed.placed[1].fixed);
}

TEST_F(PlacedTable, ReadsThePosesOfAnotherBed) {
  const Scene s = read_case(with("id,shape,x_m,y_m,z_m,qw,qx,qy,qz,scale\n0,0,0.001,0,0.002,1,0,0,0,1\n"));
  EXPECT_EQ(s.feed.placed.at(0).pose.position, Vec3(0.001, 0, 0.002));
}

TEST_F(PlacedTable, IsRefusedForAReason) {
  const auto said = [&](const std::string& table) { return message(with(table)); };
  EXPECT_NE(said("x,y_mm,z_mm\n1,2,3\n").find("column \"x\" without a unit"), std::string::npos);
  EXPECT_NE(said("x_kg,y_mm,z_mm\n1,2,3\n").find("not a unit of length"), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm\n1,2\n").find("no column \"z\""), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm,z_mm,w\n1,2,3,4\n").find("column \"w\""), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm,z_mm,x_m\n1,2,3,4\n").find("two columns \"x\""), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm,z_mm\n1,2\n").find("pellets.csv:2: found 2 values"), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm,z_mm\n1,nan,3\n").find("pellets.csv:2: y"), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm,z_mm,qw\n1,2,3,0\n").find("quaternion"), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm,z_mm,kind\n1,2,3,1.5\n").find("whole number"), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm,z_mm,scale\n1,2,3,2\n").find("no scaled pellets"), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm,z_mm\n").find("no pellets"), std::string::npos);
  EXPECT_NE(said("").find("no pellets"), std::string::npos);
}

// --- the plan --------------------------------------------------------------------------------------------

TEST(CasePlan, NamesKernelsAndWhatIsSkipped) {
  const std::string cylinders = plan(read(kCase));
  EXPECT_NE(cylinders.find("kernel cylinder"), std::string::npos) << cylinders;
  EXPECT_NE(cylinders.find("distance fields: every shape has an exact kernel"), std::string::npos);
  EXPECT_EQ(cylinders.find("friction is 0"), std::string::npos);
  EXPECT_NE(cylinders.find("about 7 layers"), std::string::npos);
  const std::string spheres = plan(read(kPlaced, {"contact.friction=0"}));
  for (const char* line : {"nothing turns a frictionless sphere", "friction is 0", "all pellets are placed"})
    EXPECT_NE(spheres.find(line), std::string::npos) << line;
}

TEST(CasePlan, HardestImpactIsTheFreeFall) {
  // sqrt(2 * 9.80665 * 0.135) = 1.6272 m/s
  EXPECT_NE(plan(read(kCase)).find("hardest impact 1.627 m/s"), std::string::npos) << plan(read(kCase));
}

// --- the scene library -----------------------------------------------------------------------------------

TEST(CaseLibrary, EveryCaseIsReadAndReadsBack) {
  int cases = 0;
  for (const auto& entry : fs::recursive_directory_iterator(PACKBED_SOURCE_DIR "/cases")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path().string());
    try {
      const Scene scene = read_case(entry.path().string());
      EXPECT_EQ(read_case_text(scene.case_text, "elsewhere.toml").case_text, scene.case_text);
      EXPECT_NE(plan(scene).find("expected (estimates)"), std::string::npos);
      ++cases;
    } catch (const InputError& e) {
      ADD_FAILURE() << e.what();
    }
  }
  EXPECT_GE(cases, 9);
}

TEST(CaseLibrary, FemdemCornersAreThePapers) {
  const std::string folder = PACKBED_SOURCE_DIR "/cases/a38_lc_corners/";
  for (const auto& [name, friction, damping] :
       {std::tuple("mu06_d04", 0.6, 0.4), std::tuple("mu06_d06", 0.6, 0.6), std::tuple("mu09_d04", 0.9, 0.4),
        std::tuple("mu09_d06", 0.9, 0.6)}) {
    const Scene s = read_case(folder + name + ".toml");
    EXPECT_EQ(s.name, name);
    EXPECT_EQ(s.pellet_contact.friction, friction);
    EXPECT_EQ(s.pellet_contact.damping_ratio, damping);
    EXPECT_EQ(s.wall_contact.friction, friction);
    EXPECT_EQ(s.feed.count, 3038);
    EXPECT_EQ(s.feed.per_layer, 49);
    EXPECT_EQ(s.pellets[0].density, 2410);
    EXPECT_EQ(s.pellets[0].shape->kind, ShapeClass::cylinder);
    // the sphere of the volume of 3.42 x 3.46 mm is 3.930 mm across (the paper rounds its own to 3.90 mm)
    EXPECT_NEAR(s.pellets[0].shape->equivalent_diameter(), std::cbrt(1.5 * 3.42 * 3.42 * 3.46) * 1e-3, 1e-7);
    EXPECT_EQ(s.container.kind, ContainerKind::tube);
    EXPECT_NEAR(s.container.radius, 22.25e-3, 1e-6);
  }
}

// --- the nearest key -------------------------------------------------------------------------------------

TEST(NearestWord, CountsLettersInsertedLeftOutChangedAndSwapped) {
  const std::vector<std::string> keys = {"friction", "damping", "stiffness", "torsion"};
  EXPECT_EQ(nearest_word("frcition", keys), "friction");
  EXPECT_EQ(nearest_word("fricton", keys), "friction");
  EXPECT_EQ(nearest_word("dampings", keys), "damping");
  EXPECT_EQ(nearest_word("portion", keys), "torsion");
  EXPECT_EQ(nearest_word("", {}), "");
}

// --- anything at all -------------------------------------------------------------------------------------

TEST(CaseFuzz, MutatedCasesAreReadOrRefused) {
  int accepted = 0, refused = 0;
  const std::string symbols = "[]{}=\"'.,#-+eE0123456789 \n\tabcmnuz\\\x80\xff";
  for (std::uint32_t i = 0; i < 2000; ++i) {
    Random random(2, Stream::test, i);
    std::string text = i % 2 ? kCase : kPlaced;
    const auto at = [&] {
      return static_cast<std::size_t>(random.uniform(0, static_cast<double>(text.size())));
    };
    for (int changes = 1 + static_cast<int>(random.uniform(0, 4)); changes > 0 && !text.empty(); --changes) {
      const std::size_t from = at(), length = static_cast<std::size_t>(random.uniform(0, 30));
      const char symbol =
          symbols[static_cast<std::size_t>(random.uniform(0, static_cast<double>(symbols.size())))];
      switch (static_cast<int>(random.uniform(0, 5))) {
        case 0:
          text[from] = symbol;
          break;
        case 1:
          text.insert(from, 1, symbol);
          break;
        case 2:
          text.erase(from, length);
          break;
        case 3:
          text.insert(at(), text.substr(from, length));
          break;
        default:
          text.resize(from);
          break;
      }
    }
    try {
      const Scene scene = read(text);
      plan(scene);
      EXPECT_EQ(read(scene.case_text).case_text, scene.case_text);
      ++accepted;
    } catch (const InputError& e) {
      EXPECT_STRNE(e.what(), "");
      ++refused;
    }
  }
  EXPECT_GT(accepted, 10);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace packbed
