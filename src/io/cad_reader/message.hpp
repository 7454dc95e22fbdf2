#pragma once
// What packbed-cad-reader tells packbed, as bytes on its standard output. Both sides are built from this
// file; the first word holds the version, so that a reader of another build is noticed.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace packbed {

struct CadMessage {
  std::string error;   // why the file cannot be used; empty: all well, and the rest is valid
  std::string detail;  // what the file turned out to be
  std::vector<std::string> notes;
  TriangleMesh mesh;  // [m]
  std::optional<TetMesh> tets;
  int solids = 0;
  std::optional<double> volume, area;  // [m3], [m2]
};

std::vector<std::byte> encode(const CadMessage& message);
/// Nothing for bytes that are not one whole message of this version.
std::optional<CadMessage> decode(std::span<const std::byte> bytes);

/// What packbed asks of the reader: its command line.
struct CadRequest {
  std::string format, path;  // to_string(CadFormat); absolute or relative
  double scale = 1;          // metres in one unit of the file
  double chord_error = 0;
  bool want_tets = false;
  double tet_size = 0;  // [m]
  double memory = 0;    // [bytes]
  double seconds = 0;   // of processor time

  std::vector<std::string> to_arguments() const;
  static std::optional<CadRequest> from_arguments(std::span<char* const> arguments);
};

}  // namespace packbed
