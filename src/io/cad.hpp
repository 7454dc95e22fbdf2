#pragma once
// CAD and mesh files in: STEP and MSH through gmsh, STL, OBJ and PLY through assimp. Both crash, hang and
// swell on bad files, so a small program of its own (packbed-cad-reader) reads them under limits; whatever
// happens to it becomes an InputError here. Neither library is loaded into the caller.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/check.hpp"
#include "mesh/mesh.hpp"
#include "shape/container.hpp"
#include "shape/shape.hpp"

namespace packbed {

enum class CadFormat : std::uint32_t { step, msh, stl, obj, ply };
std::string_view to_string(CadFormat);

struct CadLimits {
  double seconds = 20;                            // of processor time; three times as long by the clock [s]
  std::uint64_t memory = std::uint64_t{2} << 30;  // address space [bytes]; not enforced under a sanitizer
};

struct CadOptions {
  std::string unit;  // of lengths: m, cm, mm, um, in. Mandatory for STL, OBJ, PLY and MSH, which carry
                     // none; forbidden for STEP, which has its own
  double chord_error = 2e-3;  // STEP: depth of the facets under a curved surface, fraction of its radius
  bool want_tets = false;     // fill the solid with tetrahedra (an MSH file may bring its own)
  double tet_size = 0;        // edge of a tetrahedron [m]; 0: a third of the smallest extent
  bool recognise = true;      // take what is a sphere, cylinder or tube for one (load_shape, load_container)
  CadLimits limits;
};

struct CadModel {
  std::string path;
  CadFormat format = CadFormat::stl;
  std::string detail;              // what the file turned out to be: "STL, binary, single precision"
  std::string unit;                // that the numbers of the file were read in; mm for STEP
  TriangleMesh mesh;               // [m], as the file gives it: see check_mesh
  std::optional<TetMesh> tets;     // [m]
  int solids = 0;                  // that the CAD kernel counts (STEP); 0: the format does not say
  std::optional<double> volume;    // of the exact, curved body, from the CAD kernel (STEP) [m3]
  std::optional<double> area;      // likewise [m2]
  std::vector<std::string> notes;  // what a user may want to know about how it was read
};

/// The format that the name's ending says; InputError for any other.
CadFormat cad_format(const std::string& path);
/// Metres in one of the named length unit; InputError names the accepted ones. `where` opens the message.
double length_unit(const std::string& unit, const std::string& where);

/// Reads a file in a child process under options.limits. InputError: missing or unreadable file, unit missing
/// or forbidden, whatever the reader says, and a reader that crashed, ran out of time or of memory.
CadModel read_cad(const std::string& path, const CadOptions& options = {});

/// Read, check and make; InputError with the first fatal problem of the mesh.
ShapePtr load_shape(const std::string& name, const std::string& path, const CadOptions& options = {});
Container load_container(const std::string& name, const std::string& path, const CadOptions& options = {});

}  // namespace packbed
