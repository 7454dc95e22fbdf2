#pragma once
// Mesh files written by the tests themselves.
#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <string>

#include "io/temporary_folder.hpp"
#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace packbed::test {

inline std::string mesh_file(const std::string& name) {
  return PACKBED_SOURCE_DIR "/meshes/" + name;
}

inline std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::string as_text_stl(const TriangleMesh& mesh) {
  std::string out = "solid test\n";
  for (const auto& t : mesh.triangles) {
    const Vec3 n = triangle_area_vector(mesh, t).normalized();
    out += fmt::format("facet normal {} {} {}\nouter loop\n", n.x(), n.y(), n.z());
    for (int k = 0; k < 3; ++k) {
      const Vec3& v = corner(mesh, t, k);
      out += fmt::format("vertex {} {} {}\n", v.x(), v.y(), v.z());
    }
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid test\n";
}

inline std::string as_binary_stl(const TriangleMesh& mesh) {
  std::string out(80, ' ');
  const auto put = [&](const auto& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) put(static_cast<float>(triangle_area_vector(mesh, t).normalized()[k]));
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) put(static_cast<float>(corner(mesh, t, c)[k]));
    put(std::uint16_t{0});
  }
  return out;
}

inline std::string as_obj(const TriangleMesh& mesh) {
  std::string out = "o test\n";
  for (const Vec3& v : mesh.vertices) out += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) out += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return out;
}

inline std::string as_ply(const TriangleMesh& mesh) {
  std::string out = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) out += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return out;
}

inline std::string as_surface_msh(const TriangleMesh& mesh) {
  std::string out = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    out +=
        fmt::format("{} {} {} {}\n", i + 1, mesh.vertices[i].x(), mesh.vertices[i].y(), mesh.vertices[i].z());
  out += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    out += fmt::format("{} 2 2 0 1 {} {} {}\n", i + 1, t[0] + 1, t[1] + 1, t[2] + 1);
  }
  return out + "$EndElements\n";
}

}  // namespace packbed::test
