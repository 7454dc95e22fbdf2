#pragma once
// What packbed check says of a CAD file.
#include <string>

#include "io/cad.hpp"

namespace packbed {

struct CadReport {
  std::string text;    // many lines, for people, with units
  bool usable = true;  // a packer would take it
};

/// Reads, checks and makes the file as a run would (as a container or as a pellet) and says what it found,
/// what was mended and what the packers will make of it. InputError only for a file that cannot be read at
/// all.
CadReport describe_cad(const std::string& path, const CadOptions& options, bool container);

}  // namespace packbed
