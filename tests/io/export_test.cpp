// An exported bed holds the same pellets in the same places.
#include "io/export.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "io/atomic_file.hpp"
#include "io/sample_bed.hpp"
#include "io/temporary_folder.hpp"
#include "io/vtu.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

/// The surface in a binary STL, in the file's unit.
TriangleMesh read_stl(const std::string& path) {
  const std::string bytes = read_file(path);
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  EXPECT_EQ(bytes.size(), 84 + 50 * std::size_t{count});
  TriangleMesh mesh;
  for (std::uint32_t t = 0; t < count; ++t) {
    float corners[12];
    std::memcpy(corners, bytes.data() + 84 + 50 * std::size_t{t}, sizeof corners);
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (int k = 1; k < 4; ++k)
      mesh.vertices.emplace_back(corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TriangleMesh read_obj(const std::string& path, int& objects) {
  std::istringstream lines(read_file(path));
  TriangleMesh mesh;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string word;
    cells >> word;
    if (word == "o") ++objects;
    if (word == "v") {
      Vec3 v;
      cells >> v[0] >> v[1] >> v[2];
      mesh.vertices.push_back(v);
    }
    if (word == "f") {
      std::array<std::int32_t, 3> t{};
      cells >> t[0] >> t[1] >> t[2];
      for (auto& i : t) --i;
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

double volume_of(const PackedBed& bed) {
  double volume = 0;
  for (const Pellet& p : bed.pellets)
    volume += std::pow(p.scale, 3) * mass_properties(bed.shapes[p.shape]->surface).volume;
  return volume;
}

TEST(Export, ManySpheresArePointsWithTheirDiameters) {
  const TemporaryFolder folder;
  Shape ball;
  ball.kind = ShapeClass::sphere;
  ball.radius = 1e-3;
  ball.surface = {{{0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}}, {{0, 1, 2}}};
  PackedBed bed;
  bed.shapes = {std::make_shared<Shape>(ball)};
  const auto head_with = [&](std::size_t pellets) {
    for (auto id = static_cast<std::uint32_t>(bed.pellets.size()); id < pellets; ++id) {
      bed.pellets.emplace_back();
      bed.pellets.back().id = id;
    }
    write_vtu(folder / "bed.vtu", bed);
    return read_file(folder / "bed.vtu").substr(0, 1000);
  };
  const std::string few = head_with(kMostDrawnSpheres), many = head_with(kMostDrawnSpheres + 1);
  EXPECT_NE(few.find("NumberOfPoints=\"15000\" NumberOfCells=\"5000\""), std::string::npos) << few;
  EXPECT_EQ(few.find("diameter_m"), std::string::npos) << few;
  EXPECT_NE(many.find("NumberOfPoints=\"5001\" NumberOfCells=\"5001\""), std::string::npos) << many;
  EXPECT_NE(many.find("diameter_m"), std::string::npos) << many;
}

TEST(Export, StlHoldsTheVolumeInCubicMillimetres) {
  const TemporaryFolder folder;
  PackedBed bed = sample_bed(30);
  bed.pellets[3].scale = 0.5;
  export_bed(bed, export_kind_from("stl"), folder / "bed.stl");
  const double volume = mass_properties(read_stl(folder / "bed.stl")).volume;
  EXPECT_NEAR(volume / (1e9 * volume_of(bed)), 1, 1e-4);
}

TEST(Export, ObjHoldsOneObjectAPelletInMetres) {
  const TemporaryFolder folder;
  const PackedBed bed = sample_bed(30);
  export_bed(bed, export_kind_from("obj"), folder / "bed.obj");
  int objects = 0;
  const TriangleMesh mesh = read_obj(folder / "bed.obj", objects);
  EXPECT_EQ(objects, 30);
  const MassProperties all = mass_properties(mesh);
  EXPECT_NEAR(all.volume / volume_of(bed), 1, 1e-6);
  Vec3 centre = Vec3::Zero();
  for (const Pellet& p : bed.pellets) centre += p.pose.position / 30;
  EXPECT_LT((all.centre - centre).norm(), 1e-7);
}

TEST(Export, AnUnknownKindNamesTheKinds) {
  try {
    export_kind_from("step");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("stl, vtu, csv, obj, contacts"), std::string::npos);
  }
}

}  // namespace
}  // namespace packbed
