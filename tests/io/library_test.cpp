// The shapes of the library against their closed forms and against the same bodies as CAD; and what is
// refused.
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <sstream>

#include "io/cad.hpp"
#include "io/cad_files.hpp"
#include "io/case_texts.hpp"
#include "mesh/check.hpp"

namespace packbed {
namespace {

using namespace test;

std::string size_text(const toml::node& value) {
  if (const toml::array* list = value.as_array()) {
    std::string out;
    for (const auto& one : *list)
      out += fmt::format("{}\"{} mm\"", out.empty() ? "" : ", ", one.value_or(0.0));
    return "[" + out + "]";
  }
  if (value.is_integer()) return fmt::format("{}", value.value_or(0));
  return fmt::format("\"{} mm\"", value.value_or(0.0));
}

/// The body of bodies.toml as the [pellet] of a case that is given by sizes.
std::string pellet_text(const toml::table& body) {
  std::string out = fmt::format("[pellet]\nshape = \"{}\"\n", body["shape"].value_or(""));
  for (const auto& [key, value] : body)
    if (key != "shape" && key != "msh_size") out += fmt::format("{} = {}\n", key.str(), size_text(value));
  return out + "density = \"2.41 g/cm3\"\n";
}

ShapePtr shape_of(const std::string& pellet) {
  const std::string rest = kCase.substr(kCase.find("[container]"));
  return read_case_text(pellet + rest, "bed.toml", {"analysis.voxels=false"}).pellets[0].shape;
}

struct Row {
  double volume = 0, area = 0;
  Vec3 inertia = Vec3::Zero();
};
Row row_of(const std::string& name) {
  std::istringstream in(content_of(mesh_file("table.csv")));
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(name + ",", 0) != 0) continue;
    std::istringstream fields(line.substr(name.size() + 1));
    Row r;
    char comma = 0;
    double centre = 0;
    fields >> r.volume >> comma >> r.area >> comma >> centre;
    for (int k = 0; k < 3; ++k) fields >> comma >> r.inertia[k];
    return r;
  }
  ADD_FAILURE() << name;
  return {};
}

void expect_row(const Shape& s, const Row& row, double chord, const std::string& name) {
  EXPECT_NEAR(s.area * 1e6 / row.area, 1, 2 * chord) << name;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(s.inertia[k] * 1e15 / row.inertia[k], 1, 2 * chord) << name;
}

TEST(LongLibrary, EveryShapeIsTheSameBySizesAndByCad) {
  const toml::table bodies = toml::parse_file(mesh_file("bodies.toml"));
  int compared = 0;
  for (const auto& [key, value] : bodies) {
    const toml::table& body = *value.as_table();
    const std::string name(key.str());
    if (!body.contains("shape") || body["shape"].value_or(std::string()) == "pall") continue;
    const ShapePtr sized = shape_of(pellet_text(body)), cad = load_shape(name, mesh_file(name + ".step"));
    const Row row = row_of(name);
    EXPECT_EQ(sized->kind, cad->kind) << name;
    EXPECT_NEAR(sized->volume * 1e9 / row.volume, 1, 1e-10) << name;
    EXPECT_NEAR(cad->volume * 1e9 / row.volume, 1, name == "ellipsoid" ? 1e-3 : 1e-6) << name;
    expect_row(*sized, row, 2e-3, name + " by sizes");
    expect_row(*cad, row, 2e-3, name + " from CAD");
    EXPECT_NEAR(sized->smallest_thickness / cad->smallest_thickness, 1, 0.02) << name;
    EXPECT_NEAR(sized->bounding_radius / cad->bounding_radius, 1, 1e-2) << name;
    EXPECT_EQ(sized->planes.size(), cad->planes.size()) << name;
    EXPECT_EQ(check_mesh(sized->surface).fatal(), nullptr) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 12);
}

TEST(Library, ChordErrorSaysHowFineFacetsAre) {
  const std::string trilobe =
      "[pellet]\nshape = \"lobed\"\nlobes = 3\ndiameter = \"3.42 mm\"\nlobe_diameter = \"1.7 mm\"\n"
      "height = \"3.46 mm\"\ndensity = \"2.41 g/cm3\"\n";
  const Row row = row_of("trilobe");
  std::size_t before = 0;
  for (const double chord : {0.05, 0.01, 0.002, 0.0004}) {
    const ShapePtr s = shape_of(trilobe + fmt::format("chord_error = {}\n", chord));
    EXPECT_GT(s->surface.triangles.size(), before);
    before = s->surface.triangles.size();
    EXPECT_NEAR(s->volume * 1e9 / row.volume, 1, 1e-10);
    expect_row(*s, row, chord, fmt::format("{}", chord));
  }
}

TEST(Library, SizesComeBackFromTheWrittenCase) {
  const std::string ring =
      "[pellet]\nshape = \"ring\"\ndiameter = \"4.6 mm\"\ninner_diameter = \"2.5 mm\"\n"
      "height = \"5 mm\"\ndensity = \"0.9 g/cm3\"\n";
  const Scene scene = read_case_text(ring + kCase.substr(kCase.find("[container]")), "bed.toml");
  EXPECT_EQ(read_case_text(scene.case_text, "bed.toml").case_text, scene.case_text);
  EXPECT_EQ(scene.pellets[0].shape->kind, ShapeClass::tube);
}

void expect_refused(const std::string& pellet, const std::vector<std::string>& words) {
  const std::string message =
      refusal("[pellet]\n" + pellet + "density = \"1 g/cm3\"\n" + kCase.substr(kCase.find("[container]")));
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in: " << message;
}

TEST(Library, SizesThatDoNotFitTogetherAreRefused) {
  expect_refused("shape = \"ring\"\ndiameter = \"4 mm\"\ninner_diameter = \"4 mm\"\nheight = \"5 mm\"\n",
                 {"inner_diameter", "found 4 mm", "less than the diameter"});
  expect_refused(
      "shape = \"star\"\npoints = 13\ndiameter = \"3 mm\"\ninner_diameter = \"4 mm\"\nheight = \"5 mm\"\n",
      {"inner_diameter", "found 4 mm", "less than the diameter, 3 mm"});
  expect_refused(
      "shape = \"lobed\"\nlobes = 3\ndiameter = \"4 mm\"\nlobe_diameter = \"1 mm\"\nheight = \"5 mm\"\n",
      {"lobe_diameter", "found 1 mm", "so that the lobes meet"});
  expect_refused(
      "shape = \"holed\"\nholes = 4\ndiameter = \"4 mm\"\nhole_diameter = \"1.2 mm\"\n"
      "hole_circle = \"1.6 mm\"\nheight = \"5 mm\"\n",
      {"hole_diameter", "found 1.2 mm", "wall stays between the holes"});
  expect_refused(
      "shape = \"holed\"\nholes = 4\ndiameter = \"4 mm\"\nhole_diameter = \"1 mm\"\n"
      "hole_circle = \"3.5 mm\"\nheight = \"5 mm\"\n",
      {"hole_circle", "found 3.5 mm", "the holes stay inside"});
  expect_refused(
      "shape = \"dished\"\ndiameter = \"4 mm\"\nheight = \"2 mm\"\ndish_diameter = \"3 mm\"\n"
      "dish_depth = \"1 mm\"\n",
      {"dish_depth", "found 1 mm", "less than half of the height, 1 mm"});
}

TEST(Library, SizesOfOtherShapesAreRefusedAndMissingOnesNamed) {
  expect_refused("shape = \"ring\"\ndiameter = \"4 mm\"\nheight = \"5 mm\"\n",
                 {"pellet.inner_diameter", "found nothing"});
  expect_refused("shape = \"box\"\nsize = [\"1 mm\", \"2 mm\", \"3 mm\"]\nlobes = 3\n",
                 {"pellet.lobes", "only with shape = \"lobed\""});
  expect_refused("shape = \"rnig\"\n", {"did you mean \"ring\""});
}

}  // namespace
}  // namespace packbed
