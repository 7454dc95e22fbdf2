// One test a reason for which a case is refused: the message names file, line, key, what was found, what is
// allowed.
#include <gtest/gtest.h>

#include <cmath>

#include "io/case_texts.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

/// kCase with one line changed must be refused with all of these words.
void expect_refused(const std::string& from, const std::string& to, const std::vector<std::string>& words) {
  const std::string message = refusal(replaced(kCase, from, to));
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in: " << message;
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
                 {"contact.restitution", "one of damping, restitution, dissipation, not both"});
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
  // corner to corner it is sqrt(3.42^2 + 3.46^2) = 4.865 mm, and a little more where its facets stand out
  expect_refused("44.5 mm", "4.8 mm", {"pellet", "4.86", "mm across", "every rotation"});
  EXPECT_EQ(refusal(replaced(kCase, "44.5 mm", "4.9 mm")), "");
}

TEST(CaseRefuses, EntryInsideTheFloor) {
  expect_refused("135 mm", "2 mm", {"feed.drop_height", "at least 2.43", "inside the floor"});
}

TEST(CaseRefuses, EntryOutsideTheContainer) {
  expect_refused("count = 300", "count = 300\nradius = \"23 mm\"", {"feed.radius", "at most 19.8"});
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
                 {"bed.toml:14: feed.kind", "\"layers\", \"pour\", \"lattice\", \"scatter\", \"placed\"",
                  "did you mean \"layers\"?"});
  expect_refused("\"tube\"", "3", {"container.shape", "found 3"});
  EXPECT_NE(refusal("method = \"digipak\"\n" + kCase).find("\"mesh\""), std::string::npos);
}

TEST(CaseRefuses, KeyThatHasNoMeaningHere) {
  expect_refused("shape = \"cylinder\"", "shape = \"sphere\"",
                 {"bed.toml:4: pellet.height", "only with shape = \"cylinder\" or \"ring\""});
  expect_refused("kind = \"layers\"", "kind = \"placed\"", {"feed.count", "only with kind not \"placed\""});
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
  const Scene s = read_case(with("id,shape,x_m,y_m,z_m,qw,qx,qy,qz,scale\n0,0,0.001,0,0.002,1,0,0,0,0.5\n"));
  EXPECT_EQ(s.feed.placed.at(0).scale, 0.5);
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
  EXPECT_NE(said("x_mm,y_mm,z_mm,scale\n1,2,3,0\n").find("greater than 0"), std::string::npos);
  EXPECT_NE(said("x_mm,y_mm,z_mm\n").find("no pellets"), std::string::npos);
  EXPECT_NE(said("").find("no pellets"), std::string::npos);
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
