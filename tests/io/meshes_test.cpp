// The files in meshes/ against the table of closed forms, and the table against the forms themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "io/cad.hpp"
#include "io/cad_files.hpp"

namespace packbed {
namespace {

using namespace test;

struct Row {
  double volume, area, centre_z, across, axis;  // mm3, mm2, mm, mm5, mm5
};

std::map<std::string, Row> table(const std::string& file) {
  std::map<std::string, Row> out;
  std::istringstream in(content_of(file));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "body,volume_mm3,area_mm2,centre_z_mm,inertia_across_mm5,inertia_axis_mm5");
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string name;
    Row r{};
    char comma = 0;
    std::getline(fields, name, ',');
    fields >> r.volume >> comma >> r.area >> comma >> r.centre_z >> comma >> r.across >> comma >> r.axis;
    EXPECT_TRUE(fields) << line;
    out[name] = r;
  }
  return out;
}

// A solid frustum of radii a (at z0) and b (at z0 + h) with moments about the origin, by the textbook.
struct Moments {
  double volume = 0, first = 0, across = 0, axis = 0;
  Moments& operator+=(const Moments& m) {
    volume += m.volume;
    first += m.first;
    across += m.across;
    axis += m.axis;
    return *this;
  }
  Moments operator-() const { return {-volume, -first, -across, -axis}; }
};
Moments frustum(double a, double b, double z0, double h) {
  const double s2 = (a * a + a * b + b * b) / 3,
               s4 = (std::pow(a, 4) + a * a * a * b + a * a * b * b + a * b * b * b + std::pow(b, 4)) / 5;
  const double z1 = (a * a + 2 * a * b + 3 * b * b) / 12;  // of r^2 t
  const double z2 = (a * a + 3 * a * b + 6 * b * b) / 30;  // of r^2 t^2
  const double volume = kPi * h * s2;
  return {volume, z0 * volume + kPi * h * h * z1,
          kPi * h * s4 / 4 + z0 * z0 * volume + 2 * z0 * kPi * h * h * z1 + kPi * h * h * h * z2,
          kPi * h * s4 / 2};
}

void expect_row(const Row& row, const Moments& m) {
  const double centre = m.first / m.volume;
  EXPECT_NEAR(row.volume / m.volume, 1, 1e-11);
  EXPECT_NEAR(row.centre_z, centre, 1e-9);
  EXPECT_NEAR(row.across / (m.across - m.volume * centre * centre), 1, 1e-10);
  EXPECT_NEAR(row.axis / m.axis, 1, 1e-11);
}

TEST(Meshes, TableHasTheClosedForms) {
  const auto rows = table(mesh_file("table.csv"));
  expect_row(rows.at("a38"), frustum(1.71, 1.71, -1.73, 3.46));
  Moments lc = frustum(25.25, 25.25, -3, 143);
  lc += -frustum(22.25, 22.25, 0, 140);
  expect_row(rows.at("lc"), lc);
  Moments taper = frustum(23, 25.25, -3, 123);
  taper += -frustum(20, 22.25, 0, 120);
  expect_row(rows.at("taper"), taper);
  const auto ring = [](double outer, double inner) { return kPi * (outer * outer - inner * inner); };
  const auto side = [](double a, double b, double h) { return kPi * (a + b) * std::hypot(a - b, h); };
  EXPECT_NEAR(rows.at("a38").area, 2 * ring(1.71, 0) + side(1.71, 1.71, 3.46), 1e-9);
  EXPECT_NEAR(rows.at("lc").area, 2 * ring(25.25, 0) + side(25.25, 25.25, 143) + side(22.25, 22.25, 140),
              1e-5);
  EXPECT_NEAR(rows.at("taper").area,
              ring(23, 0) + side(23, 25.25, 123) + ring(25.25, 22.25) + side(22.25, 20, 120) + ring(20, 0),
              1e-5);
}

// A regular n-gon in a circle has n/(2 pi) sin(2 pi/n) of its area and (2 + cos(2 pi/n))/3 of that of its
// polar moment: exact for every body of revolution cut into n sides.
void expect_stl(const std::string& path, const Row& row, int n) {
  CadOptions options;
  options.unit = "mm";
  const MassProperties m = mass_properties(read_cad(path, options).mesh);
  const double a = 2 * kPi / n, share = std::sin(a) / a;
  EXPECT_NEAR(m.volume * 1e9 / (row.volume * share), 1, 1e-6) << path;
  EXPECT_NEAR(m.centre.z() * 1e3, row.centre_z, 1e-4) << path;
  EXPECT_NEAR(m.inertia(2, 2) * 1e15 / (row.axis * share * (2 + std::cos(a)) / 3), 1, 2e-6) << path;
  EXPECT_NEAR(m.area * 1e6 / row.area, 1, 3e-3) << path;
}

void expect_step(const std::string& path, const Row& row) {
  const CadModel model = read_cad(path);
  ASSERT_TRUE(model.volume && model.area) << path;
  EXPECT_NEAR(*model.volume * 1e9 / row.volume, 1, 1e-6) << path;
  EXPECT_NEAR(*model.area * 1e6 / row.area, 1, 1e-6) << path;
  const MassProperties m = mass_properties(model.mesh);
  EXPECT_NEAR(m.volume * 1e9 / row.volume, 1, 4e-3) << path;  // two chord errors
  EXPECT_NEAR(m.area * 1e6 / row.area, 1, 4e-3) << path;
  EXPECT_NEAR(m.centre.z() * 1e3, row.centre_z, 2e-3 * std::cbrt(row.volume)) << path;
  EXPECT_NEAR(m.inertia(2, 2) * 1e15 / row.axis, 1, 8e-3) << path;  // goes with the fourth power
  EXPECT_NEAR(m.inertia(0, 0) * 1e15 / row.across, 1, 8e-3) << path;
}

void expect_all(const std::string& folder) {
  const auto rows = table(mesh_file("table.csv"));
  for (const auto& [name, sides] : {std::pair{"a38", 48}, std::pair{"lc", 72}, std::pair{"taper", 96}}) {
    expect_step(fmt::format("{}/{}.step", folder, name), rows.at(name));
    expect_stl(fmt::format("{}/{}.stl", folder, name), rows.at(name), sides);
  }
  CadOptions options;
  options.unit = "mm";
  for (const char* name : {"a38.msh", "a38_22.msh"}) {
    const double share =
        mass_properties(read_cad(folder + "/" + name, options).mesh).volume * 1e9 / rows.at("a38").volume;
    EXPECT_LT(share, 1);
    EXPECT_GT(share, 9 / (2 * kPi) * std::sin(2 * kPi / 9));  // no coarser than nine sides
  }
}

TEST(Meshes, FilesFollowTheTable) {
  expect_all(PACKBED_SOURCE_DIR "/meshes");
}

TEST(Meshes, SourcesGiveTheSameFilesAnew) {
  const TemporaryFolder folder;
  const std::string command = fmt::format("ASAN_OPTIONS=detect_leaks=0 '{}' '{}' '{}' >/dev/null 2>&1",
                                          PACKBED_MESHES_PROGRAM, mesh_file("bodies.toml"), folder.path());
  ASSERT_EQ(std::system(command.c_str()), 0);
  expect_all(folder.path());
  for (const char* name : {"a38.stl", "lc.stl", "taper.stl"})
    EXPECT_EQ(content_of(folder.file(name)), content_of(mesh_file(name))) << name;
}

}  // namespace
}  // namespace packbed
