// Every format gives the same body; every kind of bad file gives its own message.
#include "io/cad.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <limits>

#include "io/cad_files.hpp"
#include "io/cad_report.hpp"
#include "math/error.hpp"
#include "mesh/build.hpp"

namespace packbed {
namespace {

using namespace test;

constexpr double kR = 1.71, kH = 3.46;  // A38 [mm]
const double kVolume = kPi * kR * kR * kH * 1e-9;

TriangleMesh a38(int sides = 48) {
  return revolved({{0, 0}, {kR, 0}, {kR, kH}, {0, kH}}, sides);
}
TriangleMesh cube() {
  return box_mesh(Vec3(0, 0, 0), Vec3(1, 2, 4));
}

CadOptions mm() {
  CadOptions options;
  options.unit = "mm";
  return options;
}

// The message of the InputError; empty when none came.
template <class Call>
std::string refused(const Call& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}
std::string refused_shape(const std::string& path, const CadOptions& options = mm()) {
  return refused([&] { load_shape("p", path, options); });
}

#define EXPECT_SAYS(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

TEST(ReadCad, StepHasTheExactVolumeAndIsRecognised) {
  const CadModel model = read_cad(mesh_file("a38.step"));
  ASSERT_TRUE(model.volume.has_value());
  EXPECT_NEAR(*model.volume / kVolume, 1, 1e-6);
  EXPECT_NEAR(*model.area / (2 * kPi * kR * (kR + kH) * 1e-6), 1, 1e-6);
  EXPECT_EQ(model.solids, 1);
  const ShapePtr s = load_shape("a38", mesh_file("a38.step"));
  ASSERT_EQ(s->kind, ShapeClass::cylinder);
  EXPECT_NEAR(2 * s->radius, 3.42e-3, 1e-9);
  EXPECT_NEAR(2 * s->half_height, 3.46e-3, 1e-9);
  EXPECT_LT(s->mesh_volume, s->volume);
}

TEST(ReadCad, EveryTriangleFormatGivesTheSameBody) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = a38();
  const double volume = mass_properties(mesh).volume * 1e-9;
  for (const auto& [name, content] :
       {std::pair{"text.stl", as_text_stl(mesh)}, std::pair{"binary.STL", as_binary_stl(mesh)},
        std::pair{"a.obj", as_obj(mesh)}, std::pair{"a.ply", as_ply(mesh)},
        std::pair{"a.msh", as_surface_msh(mesh)}}) {
    const std::string path = folder.write(name, content);
    EXPECT_EQ(refused_shape(path), "") << name;
    const ShapePtr s = load_shape("p", path, mm());
    EXPECT_EQ(s->kind, ShapeClass::cylinder) << name;
    EXPECT_NEAR(s->mesh_volume / volume, 1, 2e-6) << name;
    EXPECT_NEAR(s->volume / kVolume, 1, 2e-6) << name;
  }
}

TEST(ReadCad, UnitsScaleLengths) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.stl", as_text_stl(cube()));
  for (const auto& [unit, metres] : {std::pair{"m", 1.0}, std::pair{"cm", 1e-2}, std::pair{"mm", 1e-3},
                                     std::pair{"um", 1e-6}, std::pair{"in", 0.0254}}) {
    CadOptions options;
    options.unit = unit;
    const MassProperties m = mass_properties(read_cad(path, options).mesh);
    EXPECT_NEAR(m.volume / (8 * metres * metres * metres), 1, 1e-6) << unit;
  }
}

TEST(ReadCad, QuadranglesAreCut) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.obj",
                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                   "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const ShapePtr s = load_shape("cube", path, mm());
  EXPECT_NEAR(s->volume, 1e-9, 1e-15);
  EXPECT_EQ(s->surface.triangles.size(), 12u);
}

TEST(ReadCad, MshOfBothVersionsHasThePapersTetrahedra) {
  for (const char* name : {"a38.msh", "a38_22.msh"}) {
    CadOptions options = mm();
    options.want_tets = true;
    const CadModel model = read_cad(mesh_file(name), options);
    ASSERT_TRUE(model.tets.has_value());
    EXPECT_NEAR(static_cast<double>(model.tets->tets.size()), 159, 2);
    const double volume = mass_properties(*model.tets).volume;
    EXPECT_NEAR(volume / mass_properties(model.mesh).volume, 1, 1e-12);
    EXPECT_LT(volume, kVolume);
    const ShapePtr s = load_shape("a38", mesh_file(name), options);
    EXPECT_EQ(s->kind, ShapeClass::cylinder);
    EXPECT_NEAR(s->volume / kVolume, 1, 1e-6);
    EXPECT_NEAR(mass_properties(*s->tets).volume / kVolume, 1, 1e-6);
  }
}

TEST(ReadCad, TetrahedraOnRequestFillStepAndSurfaceMeshes) {
  const TemporaryFolder folder;
  CadOptions options = mm();
  options.want_tets = true;
  options.tet_size = 1e-3;
  const ShapePtr stl = load_shape("p", folder.write("a.stl", as_binary_stl(a38(24))), options);
  ASSERT_TRUE(stl->tets.has_value());
  EXPECT_GT(stl->tets->tets.size(), 50u);
  EXPECT_NEAR(mass_properties(*stl->tets).volume / stl->volume, 1, 1e-9);
  options.unit.clear();
  const CadModel step = read_cad(mesh_file("a38.step"), options);
  EXPECT_GT(step.tets->tets.size(), 50u);
  // coarse tetrahedra lie under the round side: their volume is short, and by no more than their facets say
  const double share = mass_properties(*step.tets).volume / *step.volume;
  EXPECT_LT(share, 1);
  EXPECT_GT(share, 0.9);
}

TEST(ReadCad, ChordErrorBoundsTheFacets) {
  CadOptions coarse, fine;
  coarse.chord_error = 2e-2;
  fine.chord_error = 5e-4;
  const double short_of[] = {
      1 - mass_properties(read_cad(mesh_file("a38.step"), coarse).mesh).volume / kVolume,
      1 - mass_properties(read_cad(mesh_file("a38.step"), fine).mesh).volume / kVolume};
  EXPECT_GT(short_of[0], 0);
  EXPECT_LT(short_of[0], 2 * 2e-2);
  EXPECT_LT(short_of[1], 2 * 5e-4);
}

TEST(LoadContainer, LcIsATubeFromStepAndStl) {
  for (const auto& [name, options] : {std::pair{"lc.step", CadOptions{}}, std::pair{"lc.stl", mm()}}) {
    const Container c = load_container("lc", mesh_file(name), options);
    ASSERT_EQ(c.kind, ContainerKind::tube) << name;
    EXPECT_NEAR(c.radius, 22.25e-3, 2e-8);
    EXPECT_NEAR(c.height, 140e-3, 2e-8);
  }
}

TEST(LoadContainer, TaperIsAMesh) {
  for (const auto& [name, options] : {std::pair{"taper.step", CadOptions{}}, std::pair{"taper.stl", mm()}}) {
    const Container c = load_container("taper", mesh_file(name), options);
    ASSERT_EQ(c.kind, ContainerKind::mesh) << name;
    EXPECT_NEAR(c.height, 120e-3, 1e-7);
    EXPECT_NEAR(c.radius, 21.125e-3, 5e-5);
  }
}

// --- bad input: one test a reason ---------------------------------------------------------------------

TEST(BadCad, MissingFile) {
  EXPECT_SAYS(refused_shape("/nowhere/a.stl"), "no such file");
}
TEST(BadCad, Folder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.stl");
  EXPECT_SAYS(refused_shape(folder / "a.stl"), "a folder");
}
TEST(BadCad, UnknownEnding) {
  EXPECT_SAYS(refused_shape("a.docx"), "the ending .docx");
}

TEST(BadCad, UnitMissing) {
  const TemporaryFolder folder;
  for (const char* name : {"a.stl", "a.obj", "a.ply", "a.msh"}) {
    const std::string message = refused_shape(folder.write(name, "x"), {});
    EXPECT_SAYS(message, "no unit");
    EXPECT_SAYS(message, "m, cm, mm, um");
  }
}
TEST(BadCad, UnitUnknown) {
  CadOptions options;
  for (const char* unit : {"furlong", "mm mm", "1", "kg", "3 mm"}) {
    options.unit = unit;
    EXPECT_SAYS(refused_shape(mesh_file("a38.stl"), options), fmt::format("unit = \"{}\"", unit));
  }
}
TEST(BadCad, UnitForStep) {
  EXPECT_SAYS(refused_shape(mesh_file("a38.step"), mm()), "a STEP file has its own");
}

TEST(BadCad, EmptyFile) {
  const TemporaryFolder folder;
  for (const char* name : {"a.step", "a.msh", "a.stl", "a.obj", "a.ply"}) {
    const CadOptions options = std::string(name) == "a.step" ? CadOptions{} : mm();
    EXPECT_SAYS(refused_shape(folder.write(name, ""), options), "an empty file");
  }
}
TEST(BadCad, NothingInIt) {
  const TemporaryFolder folder;
  EXPECT_NE(refused_shape(folder.write("a.stl", "solid x\nendsolid x\n")), "");
  EXPECT_NE(refused_shape(folder.write("b.stl", as_binary_stl({}))), "");
  EXPECT_NE(refused_shape(folder.write("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")), "");
  EXPECT_NE(
      refused_shape(
          folder.write("a.step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n"), {}),
      "");
}
TEST(BadCad, Truncated) {
  const TemporaryFolder folder;
  const auto half = [](const std::string& s) { return s.substr(0, s.size() / 2); };
  EXPECT_NE(refused_shape(folder.write("t.stl", half(as_text_stl(cube())))), "");
  EXPECT_NE(refused_shape(folder.write("b.stl", half(as_binary_stl(cube())))), "");
  EXPECT_NE(refused_shape(folder.write("a.obj", half(as_obj(cube())))), "");
  CadOptions impatient = mm();  // half a PLY can keep assimp busy for ever
  impatient.limits.seconds = 2;
  EXPECT_NE(refused_shape(folder.write("a.ply", half(as_ply(cube()))), impatient), "");
  EXPECT_NE(refused_shape(folder.write("a.msh", half(content_of(mesh_file("a38.msh"))))), "");
  EXPECT_NE(refused_shape(folder.write("b.msh", half(content_of(mesh_file("a38_22.msh"))))), "");
  EXPECT_NE(refused_shape(folder.write("a.step", half(content_of(mesh_file("a38.step")))), {}), "");
}
TEST(BadCad, AnotherKindOfFile) {
  const TemporaryFolder folder;
  EXPECT_SAYS(refused_shape(folder.write("a.step", as_text_stl(cube())), {}), "ISO-10303-21");
  EXPECT_SAYS(refused_shape(folder.write("a.msh", as_text_stl(cube()))), "$MeshFormat");
}
// gmsh runs as a script what it does not know: such a file must not reach it.
TEST(BadCad, ScriptIsNotRun) {
  const TemporaryFolder folder;
  const std::string script = fmt::format("SystemCall \"touch {}\";\n", folder / "ran");
  EXPECT_NE(refused_shape(folder.write("a.msh", script)), "");
  EXPECT_NE(refused_shape(folder.write("b.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + script)), "");
  EXPECT_FALSE(std::filesystem::exists(folder / "ran"));
}
TEST(BadCad, MshOfAnotherVersion) {
  const TemporaryFolder folder;
  EXPECT_SAYS(refused_shape(folder.write("a.msh", "$MeshFormat\n3.0 0 8\n$EndMeshFormat\n")), "\"3.0\"");
}
TEST(BadCad, MshOfHexahedra) {
  const TemporaryFolder folder;
  EXPECT_SAYS(refused_shape(folder.write(
                  "a.msh",
                  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
                  "5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n$Elements\n1\n"
                  "1 5 2 0 1 1 2 3 4 5 6 7 8\n$EndElements\n")),
              "only tetrahedra");
}
TEST(BadCad, OpenMesh) {
  const TemporaryFolder folder;
  TriangleMesh mesh = cube();
  mesh.triangles.pop_back();
  EXPECT_SAYS(refused_shape(folder.write("a.stl", as_text_stl(mesh))), "the surface is open: 3 edges");
}
TEST(BadCad, InvertedMeshIsTurned) {
  const TemporaryFolder folder;
  TriangleMesh mesh = cube();
  turn_over(mesh);
  const std::string path = folder.write("a.obj", as_obj(mesh));
  EXPECT_NEAR(load_shape("p", path, mm())->volume, 8e-9, 1e-14);
  EXPECT_SAYS(describe_cad(path, mm(), false).text, "inside out; turned");
}
TEST(BadCad, NotFinite) {
  const TemporaryFolder folder;
  std::string binary = as_binary_stl(cube());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::size_t triangle : {0u, 5u})
    for (std::size_t k = 0; k < 3; ++k)
      std::memcpy(binary.data() + 84 + 50 * triangle + 12 + 4 * k, &nan, sizeof nan);
  EXPECT_SAYS(refused_shape(folder.write("a.stl", binary)), "not a finite number");
}
TEST(BadCad, SeveralSolids) {
  const TemporaryFolder folder;
  const TriangleMesh two = merged(cube(), box_mesh(Vec3(5, 5, 5), Vec3(6, 6, 6)));
  const std::string path = folder.write("a.stl", as_text_stl(two));
  EXPECT_SAYS(refused_shape(path), "2 separate solids");
  EXPECT_EQ(refused([&] { load_container("c", path, mm()); }), "");
}
TEST(BadCad, SelfCrossing) {
  const TemporaryFolder folder;
  TriangleMesh mesh = cube();
  mesh.vertices[7] = Vec3(-1, 0.4, 0.4);
  EXPECT_SAYS(refused_shape(folder.write("a.stl", as_text_stl(mesh))), "crosses itself");
}
TEST(BadCad, Degenerate) {
  const TemporaryFolder folder;
  TriangleMesh flat;
  flat.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
  flat.triangles = {{0, 1, 2}, {1, 2, 3}, {0, 2, 3}, {0, 1, 3}};
  EXPECT_SAYS(refused_shape(folder.write("a.obj", as_obj(flat))), "without area");
}
TEST(BadCad, HeaderThatClaimsBillions) {
  const TemporaryFolder folder;
  std::string stl = as_binary_stl(cube());
  const std::uint32_t lie = 4'000'000'000u;
  std::memcpy(stl.data() + 80, &lie, sizeof lie);
  EXPECT_NE(refused_shape(folder.write("a.stl", stl)), "");
  std::string ply = as_ply(cube());
  ply.replace(ply.find("vertex 8"), 8, "vertex 4000000000");
  EXPECT_NE(refused_shape(folder.write("a.ply", ply)), "");
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  EXPECT_LT(children.ru_maxrss, 2l * 1024 * 1024);  // [kB]
}
TEST(BadCad, TimeLimitIsKept) {
  CadOptions options;
  options.limits.seconds = 0.01;  // less than the CAD kernel needs to start
  EXPECT_SAYS(refused([&] { read_cad(mesh_file("lc.step"), options); }), "within 0.01 s");
}
#ifndef PACKBED_SANITIZED
TEST(BadCad, MemoryLimitIsKept) {
  CadOptions options;
  options.chord_error = 1e-5;  // millions of facets
  options.limits.memory = std::uint64_t{150} << 20;
  EXPECT_SAYS(refused([&] { read_cad(mesh_file("a38.step"), options); }), "more memory");
}
#endif

TEST(DescribeCad, SaysWhatItIsAndWhatWillBeMade) {
  const CadReport pellet = describe_cad(mesh_file("a38.step"), {}, false);
  EXPECT_TRUE(pellet.usable);
  EXPECT_SAYS(pellet.text, "cylinder of diameter 3.42 mm and height 3.46 mm");
  EXPECT_SAYS(pellet.text, "exact, from the CAD kernel");
  const CadReport tube = describe_cad(mesh_file("lc.step"), {}, true);
  EXPECT_SAYS(tube.text, "tube of inner diameter 44.5 mm and inner height 140 mm");
  EXPECT_SAYS(describe_cad(mesh_file("taper.stl"), mm(), true).text, "field");
}
TEST(DescribeCad, SaysWhyAMeshIsRefused) {
  const TemporaryFolder folder;
  TriangleMesh mesh = cube();
  mesh.triangles.pop_back();
  const CadReport report = describe_cad(folder.write("a.stl", as_text_stl(mesh)), mm(), false);
  EXPECT_FALSE(report.usable);
  EXPECT_SAYS(report.text, "REFUSED");
}

}  // namespace
}  // namespace packbed
