#pragma once
// A bed as a file of another kind.
#include <string>

#include "bed/packed_bed.hpp"

namespace packbed {

enum class ExportKind { stl, vtu, csv, obj, contacts };
/// The ending of a file of this kind.
std::string ending(ExportKind kind);
ExportKind export_kind_from(const std::string& word);  ///< throws InputError that names the kinds

/// stl: binary, lengths in millimetres (as most programs read them), named in the header; obj: one object a
/// pellet, in metres; vtu: as write_vtu; csv: poses; contacts:
/// the table of contacts. Throws SystemError.
void export_bed(const PackedBed& bed, ExportKind kind, const std::string& path);

}  // namespace packbed
