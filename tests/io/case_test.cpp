#include "io/case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <tuple>

#include "contact/damping.hpp"
#include "io/case_reader.hpp"
#include "io/case_texts.hpp"

namespace packbed {
namespace {

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
  EXPECT_EQ(s.impact_limit, fresh.impact_limit);
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

using LongCaseFiles = CaseFiles;
TEST_F(LongCaseFiles, EveryCaseOfTheLibraryIsReadAndReadsBack) {
  int cases = 0;
  for (const auto& entry : fs::recursive_directory_iterator(PACKBED_SOURCE_DIR "/cases")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path().string());
    try {
      const Scene scene = read_case(entry.path().string());
      EXPECT_EQ(case_with_defaults(write("copy.toml", scene.case_text)), scene.case_text);
      EXPECT_NE(plan(scene).find("\nmade\n"), std::string::npos);
      ++cases;
    } catch (const InputError& e) {
      ADD_FAILURE() << e.what();
    }
  }
  EXPECT_GE(cases, 9);
}

TEST(CaseLibrary, FullBedIsTheFemdemPapers) {
  const Scene s = read_case(PACKBED_SOURCE_DIR "/cases/a38_lc_poured.toml");
  EXPECT_EQ(s.feed.count, 3038);
  EXPECT_EQ(s.feed.per_layer, 49);
  EXPECT_EQ(s.feed.speed, 0);
  EXPECT_EQ(s.pellets[0].density, 2410);
  EXPECT_EQ(s.pellets[0].shape->kind, ShapeClass::cylinder);
  // the sphere of the volume of 3.42 x 3.46 mm is 3.930 mm across (the paper rounds its own to 3.90 mm)
  EXPECT_NEAR(s.pellets[0].shape->equivalent_diameter(), std::cbrt(1.5 * 3.42 * 3.42 * 3.46) * 1e-3, 1e-7);
  EXPECT_EQ(s.container.kind, ContainerKind::tube);
  EXPECT_NEAR(s.container.radius, 22.25e-3, 1e-6);
}

TEST(CaseLibrary, CornersChangeFrictionAndDampingAndTheStepForThem) {
  const std::string folder = PACKBED_SOURCE_DIR "/cases/";
  const auto lines = [](const std::string& text) {  // of keys, without the two that say who it is
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      if (line.rfind("name =", 0) != 0 && line.rfind("folder =", 0) != 0 && line.rfind("file =", 0) != 0)
        out.push_back(line.substr(0, line.find("  #")));
    return out;
  };
  const auto base = lines(case_with_defaults(folder + "a38_lc_poured.toml"));
  for (const auto& [name, friction, damping, steps] :
       {std::tuple("mu06_d04", "0.6", "0.4", "17"), std::tuple("mu06_d06", "0.6", "0.6", "20"),
        std::tuple("mu09_d04", "0.9", "0.4", "17"), std::tuple("mu09_d06", "0.9", "0.6", "20")}) {
    auto expected = base;
    for (std::string& line : expected) {
      if (line.rfind("friction =", 0) == 0) line = line.substr(0, 11) + friction + line.substr(14);
      if (line.rfind("damping =", 0) == 0) line = line.substr(0, 10) + damping + line.substr(13);
      if (line.rfind("steps_per_contact =", 0) == 0) line = line.substr(0, 20) + steps + line.substr(22);
    }
    EXPECT_EQ(lines(case_with_defaults(folder + "a38_lc_corners/" + name + ".toml")), expected) << name;
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

}  // namespace
}  // namespace packbed
