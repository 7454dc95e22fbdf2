// packbed analyse: curves of anything that is a bed or a grid.
#include "analysis/analyse.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <thread>

#include "cli/commands.hpp"
#include "io/bed.hpp"
#include "io/curves.hpp"
#include "io/grid.hpp"
#include "io/result_folder.hpp"
#include "math/error.hpp"
#include "math/quantity.hpp"
#include "math/threads.hpp"

namespace packbed::cli {
namespace {

AnalysisResult analyse_one(const AnalyseOptions& options) {
  AnalysisWish wish;
  wish.voxel = parse_quantity(options.pitch, Dimension::length, "--pitch");
  if (!holds_grid(options.input)) return analyse_bed(read_bed(options.input), wish);
  const GridFile file = read_grid(options.input);
  wish.diameter = file.note.diameter;
  const double radius = options.container_diameter.empty()
                            ? file.note.container_radius
                            : parse_quantity(options.container_diameter, Dimension::length, "--diameter") / 2;
  return analyse_grid(file.grid, radius, wish);
}

std::string out_folder(const AnalyseOptions& options) {
  std::filesystem::path folder = options.out;
  if (options.out.empty()) {
    folder = options.input;
    if (!std::filesystem::is_directory(folder)) folder = folder.parent_path();
    return folder.empty() ? "." : folder.string();
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw InputError(options.out, error.message(), "a folder that can be made", "choose another --out");
  return folder.string();
}

void print(const AnalysisResult& r, const std::string& folder) {
  const auto line = [](const char* name, const std::string& value) {
    fmt::print("{:<22} {}\n", name, value);
  };
  const BulkDensity& b = r.bulk;
  line("bed height", format_quantity(r.bed_height_m, Dimension::length));
  if (std::isfinite(b.packing_density))
    line("packing density", fmt::format("{:.4f} from voxels", b.packing_density));
  if (std::isfinite(b.exact)) line("packing density", fmt::format("{:.4f} exact", b.exact));
  line("axial spread", fmt::format("{:.4f}", b.axial_sd));
  line("", b.definition);
  if (r.core && std::isfinite(r.core->best())) line("core porosity", fmt::format("{:.4f}", r.core->best()));
  if (r.core) line("", r.core->definition);
  if (r.segregation) line("segregation", fmt::format("{:+.4f} along the height", r.segregation->along[2]));
  if (r.coordination) line("touching pellets", fmt::format("{:.3f} each", r.coordination->mean));
  if (r.overlap)
    line("overlap",
         fmt::format("{} touching pairs; mean {:.3g} %, largest {:.3g} % of the smallest thickness",
                     r.overlap->pairs, 100 * r.overlap->mean, 100 * r.overlap->max));
  line("processor time",
       fmt::format("{:.2f} s voxels, {:.2f} s analysis", r.voxelise_cpu_s, r.analyse_cpu_s));
  line("curves", folder);
}

}  // namespace

int analyse(const AnalyseOptions& options) {
  set_threads(options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency()));
  const AnalysisResult result = analyse_one(options);
  const std::string folder = out_folder(options);
  write_curves(ResultFolder{folder}, result);
  print(result, folder);
  return 0;
}

}  // namespace packbed::cli
