#include <fmt/format.h>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <filesystem>
#include <fstream>

#include "io/cad_reader/readers.hpp"

namespace packbed {
namespace {

// A text file may begin with anything and a binary one with "solid": the size decides.
bool binary_stl(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  char header[84] = {};
  in.read(header, sizeof header);
  if (in.gcount() < 84) return false;
  const auto byte = [&](int i) {
    return static_cast<std::uint64_t>(static_cast<unsigned char>(header[80 + i]));
  };
  const std::uint64_t triangles = byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
  return std::filesystem::file_size(path) == 84 + 50 * triangles || std::string(header, 5) != "solid";
}

void append(const aiMesh& from, double scale, CadMessage& to, std::size_t& skipped) {
  const auto first = static_cast<std::int32_t>(to.mesh.vertices.size());
  for (unsigned v = 0; v < from.mNumVertices; ++v) {
    const aiVector3D& p = from.mVertices[v];
    to.mesh.vertices.emplace_back(scale * static_cast<double>(p.x), scale * static_cast<double>(p.y),
                                  scale * static_cast<double>(p.z));
  }
  for (unsigned f = 0; f < from.mNumFaces; ++f) {
    const aiFace& face = from.mFaces[f];
    if (face.mNumIndices != 3) {
      ++skipped;
      continue;
    }
    std::array<std::int32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = first + static_cast<std::int32_t>(face.mIndices[k]);
    to.mesh.triangles.push_back(triangle);
  }
}

}  // namespace

CadMessage read_triangles(const CadRequest& request) {
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(request.path, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw Unusable(importer.GetErrorString());
  CadMessage out;
  std::size_t skipped = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) append(*scene->mMeshes[m], request.scale, out, skipped);
  out.detail = request.format;
  if (request.format == "STL") out.detail += binary_stl(request.path) ? ", binary" : ", text";
  out.detail += ", single precision";
  if (skipped > 0) out.notes.push_back(fmt::format("{} points and lines were left out", skipped));
  return out;
}

}  // namespace packbed
