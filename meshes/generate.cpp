// Makes the CAD and mesh files of meshes/bodies.toml: STEP and MSH through gmsh, STL by turning the profile.
//   packbed-meshes bodies.toml FOLDER
#include <fmt/format.h>
#include <gmsh.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "mesh/build.hpp"
#include "mesh/topology.hpp"
#include "solids.hpp"

namespace {

using namespace packbed;
using namespace packbed::meshes;

// Of the STEP file, as its users have it: OpenCASCADE leaves fused solids in a state that cannot always be
// meshed.
void write_msh(const toml::table& body, double size, const std::string& path) {
  gmsh::clear();
  gmsh::vectorpair solids;
  gmsh::model::occ::importShapes(path + ".step", solids);
  gmsh::model::occ::synchronize();
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", size);
  gmsh::model::mesh::generate(3);
  gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
  gmsh::write(path + ".msh");
  if (!body["msh_22"].value_or(false)) return;
  gmsh::option::setNumber("Mesh.MshFileVersion", 2.2);
  gmsh::write(path + "_22.msh");
}

void write_stl(const toml::table& body, int sides, const std::string& name, const std::string& path) {
  const TriangleMesh mesh = revolved(profile_of(body), sides);
  std::ofstream out(path + ".stl", std::ios::binary);
  std::string header = fmt::format("{}, lengths in mm", name);
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
  if (!out.flush()) throw std::runtime_error("cannot write " + path + ".stl");
}

void write_body(const toml::table& body, const std::string& name, const std::string& path) {
  gmsh::model::add(name);
  build_solid(body);
  gmsh::write(path + ".step");
  if (const auto size = body["msh_size"].value<double>()) write_msh(body, *size, path);
  if (const auto sides = body["stl_sides"].value<int>()) write_stl(body, *sides, name, path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: packbed-meshes BODIES.toml FOLDER\n");
    return 2;
  }
  std::string name;
  try {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    for (const auto& [key, value] : toml::parse_file(argv[1])) {
      name = key.str();
      write_body(*value.as_table(), name, std::string(argv[2]) + "/" + name);
    }
    gmsh::finalize();
  } catch (const std::string& e) {
    std::fprintf(stderr, "packbed-meshes: %s: %s\n", name.c_str(), e.c_str());
    return 3;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "packbed-meshes: %s: %s\n", name.c_str(), e.what());
    return 3;
  }
}
