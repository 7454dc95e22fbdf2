// Makes the CAD and mesh files of meshes/bodies.toml: STEP and MSH through gmsh, STL by turning the profile.
//   packbed-meshes bodies.toml FOLDER
#include <fmt/format.h>
#include <gmsh.h>

#include <toml++/toml.h>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesh/build.hpp"
#include "mesh/topology.hpp"

namespace {

using namespace packbed;
using Profile = std::vector<std::pair<double, double>>;

struct Body {
  std::string name;
  Profile profile;  // [mm]
  bool step = false;
  int stl_sides = 0;       // 0: no STL
  double msh_size_mm = 0;  // 0: no MSH
};

std::vector<Body> read_bodies(const std::string& file) {
  std::vector<Body> out;
  for (const auto& [name, value] : toml::parse_file(file)) {
    const toml::table& table = *value.as_table();
    Body body{std::string(name.str()),
              {},
              table["step"].value_or(false),
              table["stl_sides"].value_or(0),
              table["msh_size_mm"].value_or(0.0)};
    for (const auto& point : *table["profile_mm"].as_array())
      body.profile.emplace_back((*point.as_array())[0].value_or(0.0), (*point.as_array())[1].value_or(0.0));
    out.push_back(body);
  }
  return out;
}

// The profile in the xz plane, turned once round z.
void build(const Body& body) {
  namespace occ = gmsh::model::occ;
  gmsh::model::add(body.name);
  std::vector<int> points, lines;
  for (const auto& [r, z] : body.profile) points.push_back(occ::addPoint(r, 0, z));
  for (std::size_t i = 0; i < points.size(); ++i)
    lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
  const int face = occ::addPlaneSurface({occ::addCurveLoop(lines)});
  gmsh::vectorpair made;
  occ::revolve({{2, face}}, 0, 0, 0, 0, 0, 1, 2 * kPi, made);
  gmsh::vectorpair left{{2, face}};
  for (const int line : lines) left.emplace_back(1, line);
  occ::remove(left);
  occ::synchronize();
}

void write_step_and_msh(const Body& body, const std::string& folder) {
  if (!body.step && body.msh_size_mm == 0) return;
  build(body);
  if (body.step) gmsh::write(folder + "/" + body.name + ".step");
  if (body.msh_size_mm == 0) return;
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", body.msh_size_mm);
  gmsh::model::mesh::generate(3);
  for (const auto& [version, ending] : {std::pair{4.1, ".msh"}, std::pair{2.2, "_22.msh"}}) {
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::write(folder + "/" + body.name + ending);
  }
}

void write_stl(const Body& body, const std::string& folder) {
  const TriangleMesh mesh = revolved(body.profile, body.stl_sides);
  std::ofstream out(folder + "/" + body.name + ".stl", std::ios::binary);
  std::string header = fmt::format("{}, lengths in mm", body.name);
  header.resize(80, ' ');
  out << header;
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& t : mesh.triangles) {
    const auto put = [&](const Vec3& v) {
      const Eigen::Vector3f f = v.cast<float>();
      out.write(reinterpret_cast<const char*>(f.data()), 3 * sizeof(float));
    };
    put(triangle_area_vector(mesh, t).normalized());
    for (int k = 0; k < 3; ++k) put(corner(mesh, t, k));
    const std::uint16_t attribute = 0;
    out.write(reinterpret_cast<const char*>(&attribute), sizeof attribute);
  }
  if (!out.flush()) throw std::runtime_error("cannot write to " + folder);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: packbed-meshes BODIES.toml FOLDER\n");
    return 2;
  }
  try {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    for (const Body& body : read_bodies(argv[1])) {
      write_step_and_msh(body, argv[2]);
      if (body.stl_sides > 0) write_stl(body, argv[2]);
    }
    gmsh::finalize();
  } catch (const std::string& e) {
    std::fprintf(stderr, "packbed-meshes: %s\n", e.c_str());
    return 3;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "packbed-meshes: %s\n", e.what());
    return 3;
  }
}
