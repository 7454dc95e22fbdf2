#pragma once
// The two libraries behind one face. Each reader throws Unusable with a sentence, or whatever its library
// throws.
#include <stdexcept>
#include <string>

#include "io/cad_reader/message.hpp"

namespace packbed {

struct Unusable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

CadMessage read_step(const CadRequest& request);       // gmsh
CadMessage read_msh(const CadRequest& request);        // gmsh
CadMessage read_triangles(const CadRequest& request);  // assimp: STL, OBJ, PLY

/// Tetrahedra inside a closed mesh whose triangles all stay (gmsh).
TetMesh fill_with_tets(const TriangleMesh& mesh, double size);

}  // namespace packbed
