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
  double volume = 0, area = 0, centre_z = 0;  // mm3, mm2, mm
  Vec3 inertia = Vec3::Zero();                // mm5
};

std::map<std::string, Row> table(const std::string& text) {
  std::map<std::string, Row> out;
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "body,volume_mm3,area_mm2,centre_z_mm,inertia_x_mm5,inertia_y_mm5,inertia_z_mm5");
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string name;
    Row r;
    char comma = 0;
    std::getline(fields, name, ',');
    fields >> r.volume >> comma >> r.area >> comma >> r.centre_z;
    for (int k = 0; k < 3; ++k) fields >> comma >> r.inertia[k];
    EXPECT_TRUE(fields) << line;
    out[name] = r;
  }
  return out;
}
std::map<std::string, Row> table() {
  return table(content_of(mesh_file("table.csv")));
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
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(row.inertia[k] / (m.across - m.volume * centre * centre), 1, 1e-10);
  EXPECT_NEAR(row.inertia.z() / m.axis, 1, 1e-11);
}
Moments hollow(Moments outside, const Moments& inside) {
  return outside += -inside;
}

TEST(LongMeshes, TableHasTheClosedForms) {
  const auto rows = table();
  expect_row(rows.at("a38"), frustum(1.71, 1.71, -1.73, 3.46));
  expect_row(rows.at("hama"), hollow(frustum(2.3, 2.3, -2.5, 5), frustum(1.25, 1.25, -2.5, 5)));
  expect_row(rows.at("lc"), hollow(frustum(25.25, 25.25, -3, 143), frustum(22.25, 22.25, 0, 140)));
  expect_row(rows.at("column"), hollow(frustum(150, 150, -5, 605), frustum(145, 145, 0, 600)));
  expect_row(rows.at("taper"), hollow(frustum(23, 25.25, -3, 123), frustum(20, 22.25, 0, 120)));
  Moments sc_inside = frustum(0, 12, 0, 15), sc = frustum(0, 13, -2, 16);
  sc_inside += frustum(12, 14, 15, 100);
  sc += frustum(13, 15.5, 14, 101);
  expect_row(rows.at("sc"), hollow(sc, sc_inside));
  Moments annulus = hollow(frustum(25.25, 25.25, -3, 143), frustum(22.25, 22.25, 0, 140));
  annulus += frustum(7.5, 7.5, 0, 140);
  expect_row(rows.at("annulus"), annulus);
  const auto ring = [](double outer, double inner) { return kPi * (outer * outer - inner * inner); };
  const auto side = [](double a, double b, double h) { return kPi * (a + b) * std::hypot(a - b, h); };
  EXPECT_NEAR(rows.at("a38").area, 2 * ring(1.71, 0) + side(1.71, 1.71, 3.46), 1e-9);
  EXPECT_NEAR(rows.at("hama").area, 2 * ring(2.3, 1.25) + side(2.3, 2.3, 5) + side(1.25, 1.25, 5), 1e-9);
  EXPECT_NEAR(rows.at("lc").area, 2 * ring(25.25, 0) + side(25.25, 25.25, 143) + side(22.25, 22.25, 140),
              1e-5);
  EXPECT_NEAR(rows.at("taper").area,
              ring(23, 0) + side(23, 25.25, 123) + ring(25.25, 22.25) + side(22.25, 20, 120) + ring(20, 0),
              1e-5);
}

TEST(LongMeshes, TableIsWhatItsProgramPrints) {
  const TemporaryFolder folder;
  const std::string printed = folder / "table.csv";
  const std::string command = fmt::format("'{}' '{}' > '{}'", PACKBED_PYTHON, mesh_file("table"), printed);
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto anew = table(content_of(printed)), kept = table();
  ASSERT_EQ(anew.size(), kept.size());
  for (const auto& [name, row] : kept) {
    const Row& other = anew.at(name);
    EXPECT_NEAR(other.volume / row.volume, 1, 1e-10) << name;
    EXPECT_NEAR(other.area / row.area, 1, 1e-10) << name;
    EXPECT_LT((other.inertia - row.inertia).norm(), 1e-10 * row.inertia.norm()) << name;
  }
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
  EXPECT_NEAR(m.inertia(2, 2) * 1e15 / (row.inertia.z() * share * (2 + std::cos(a)) / 3), 1, 2e-6) << path;
  EXPECT_NEAR(m.area * 1e6 / row.area, 1, 3e-3) << path;
}

void expect_step(const std::string& path, const Row& row, bool spline) {
  CadOptions options;
  options.chord_error = 5e-3;
  const CadModel model = read_cad(path, options);
  ASSERT_TRUE(model.volume && model.area) << path;
  EXPECT_EQ(model.solids, 1) << path;
  // the CAD kernel integrates over splines less sharply than over its own surfaces
  EXPECT_NEAR(*model.volume * 1e9 / row.volume, 1, spline ? 1e-3 : 1e-6) << path;
  EXPECT_NEAR(*model.area * 1e6 / row.area, 1, spline ? 5e-3 : 1e-6) << path;
  const MassProperties m = mass_properties(model.mesh);
  const double chord = options.chord_error;  // fraction of the radius; moments go with its powers
  EXPECT_NEAR(m.volume * 1e9 / row.volume, 1, 3 * chord) << path;
  EXPECT_NEAR(m.area * 1e6 / row.area, 1, 2 * chord) << path;
  EXPECT_NEAR(m.centre.z() * 1e3, row.centre_z, chord * std::cbrt(row.volume)) << path;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(m.inertia(k, k) * 1e15 / row.inertia[k], 1, 5 * chord) << path;
}

// Tetrahedra are coarse on purpose: no coarser than the nine sides that still pass for a circle.
void expect_msh(const std::string& path, const Row& row) {
  CadOptions options;
  options.unit = "mm";
  const double share = mass_properties(read_cad(path, options).mesh).volume * 1e9 / row.volume;
  const double nine = 9 / (2 * kPi) * std::sin(2 * kPi / 9);
  EXPECT_LT(std::abs(share - 1), 1 - nine) << path;
}

void expect_all(const std::string& folder) {
  for (const auto& [name, row] : table()) {
    const std::string path = fmt::format("{}/{}", folder, name);
    expect_step(path + ".step", row, name == "ellipsoid");
    if (std::filesystem::exists(path + ".msh")) expect_msh(path + ".msh", row);
  }
  for (const auto& [name, sides] :
       {std::pair{"a38", 48}, {"lc", 72}, {"sc", 72}, {"annulus", 72}, {"taper", 96}})
    expect_stl(fmt::format("{}/{}.stl", folder, name), table().at(name), sides);
  expect_msh(folder + "/a38_22.msh", table().at("a38"));
}

TEST(LongMeshes, FilesFollowTheTable) {
  expect_all(PACKBED_SOURCE_DIR "/meshes");
}

TEST(LongMeshes, EllipsoidsCornersLieOnIt) {
  for (const Vec3& p : read_cad(mesh_file("ellipsoid.step")).mesh.vertices)
    EXPECT_NEAR(p.cwiseQuotient(Vec3(2.5e-3, 2e-3, 1.6e-3)).norm(), 1, 1e-9);
}

TEST(LongMeshes, SourcesGiveTheSameFilesAnew) {
  const TemporaryFolder folder;
  const std::string command = fmt::format("ASAN_OPTIONS=detect_leaks=0 '{}' '{}' '{}' >/dev/null 2>&1",
                                          PACKBED_MESHES_PROGRAM, mesh_file("bodies.toml"), folder.path());
  ASSERT_EQ(std::system(command.c_str()), 0);
  expect_all(folder.path());
  for (const char* name : {"a38.stl", "lc.stl", "sc.stl", "annulus.stl", "taper.stl"})
    EXPECT_EQ(content_of(folder / name), content_of(mesh_file(name))) << name;
}

}  // namespace
}  // namespace packbed
