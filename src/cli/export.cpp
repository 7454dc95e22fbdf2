// packbed export: a bed as a file of another kind.
#include "io/export.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "cli/commands.hpp"
#include "io/bed.hpp"
#include "io/result_folder.hpp"

namespace packbed::cli {

int export_bed(const ExportOptions& options) {
  const ExportKind kind = export_kind_from(options.to);
  const std::filesystem::path bed_file = file_in(options.bed, result_file::kBed);
  const PackedBed bed = read_bed(bed_file.string());
  const std::string out = options.out.empty() ? bed_file.parent_path() / ("bed" + ending(kind))
                                              : std::filesystem::path(options.out);
  packbed::export_bed(bed, kind, out);
  fmt::print("{}: {} pellets\n", out, bed.pellets.size());
  return 0;
}

}  // namespace packbed::cli
