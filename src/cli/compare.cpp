// packbed compare: beds and grids side by side, or one case packed by several methods and compared.
#include <fmt/format.h>

#include <filesystem>
#include <thread>

#include "analysis/analyse.hpp"
#include "cli/commands.hpp"
#include "io/bed.hpp"
#include "io/case.hpp"
#include "io/comparison.hpp"
#include "io/grid.hpp"
#include "io/result_folder.hpp"
#include "math/error.hpp"
#include "math/quantity.hpp"
#include "math/threads.hpp"

namespace packbed::cli {
namespace {

namespace fs = std::filesystem;

std::string name_of(const std::string& input) {
  fs::path path = fs::path(input).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (!fs::is_directory(input) && path.has_parent_path()) path = path.parent_path();
  return path.filename().string();
}

/// Every bed through the same analysis, whatever its own run has measured.
Compared look_at(const std::string& input, const AnalysisWish& wish) {
  Compared out;
  out.name = name_of(input);
  if (!holds_grid(input)) {
    out.analysis = analyse_bed(read_bed(input), wish);
    out.record = read_run_record(input);
    return out;
  }
  const GridFile file = read_grid(input);
  AnalysisWish own = wish;
  if (!(own.diameter > 0)) own.diameter = file.note.diameter;
  out.analysis = analyse_grid(file.grid, file.note.container_radius, own);
  return out;
}

/// What all beds are measured by: what the options say, and for the rest the case of the first bed.
AnalysisWish wish_of(const CompareOptions& options) {
  AnalysisWish wish;
  const std::string& first = options.inputs.front();
  const std::string text = holds_grid(first) ? "" : read_bed(first).provenance.case_text;
  try {
    if (!text.empty()) wish = read_analysis(text, first);
  } catch (const InputError&) {  // of a version whose keys are not today's: as a case is by itself
  }
  if (options.pitch) wish.voxel = parse_quantity(*options.pitch, Dimension::length, "--pitch");
  if (options.from) wish.from_diameters = *options.from;
  if (options.to) wish.to_diameters = *options.to;
  wish.voxels = wish.orientation = wish.exact = true;
  wish.overlap = false;
  return wish;
}

/// Packs the case by every method that has not been packed yet; returns the folders.
std::vector<std::string> ladder(const CompareOptions& options) {
  if (options.inputs.size() != 1)
    throw InputError("--ladder", fmt::format("{} inputs", options.inputs.size()), "one case file");
  std::vector<std::string> folders;
  for (const std::string& method : options.methods) {
    RunOptions one;
    one.case_file = options.inputs.front();
    one.sets = options.sets;
    one.sets.push_back("method=" + method);
    one.seed = options.seed;
    one.threads = options.threads;
    one.quiet = options.quiet;
    one.out = (fs::path(options.out) / method).string();
    folders.push_back(one.out);
    if (fs::exists(fs::path(one.out) / result_file::kSummary)) continue;  // of an earlier call
    one.force = true;
    run(one);
  }
  return folders;
}

}  // namespace

int compare(const CompareOptions& given) {
  CompareOptions options = given;
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error)
    throw InputError(options.out, error.message(), "a folder that can be made", "choose another --out");
  if (options.ladder) options.inputs = ladder(options);
  set_threads(options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency()));
  const AnalysisWish wish = wish_of(options);
  std::vector<Compared> beds;
  for (const std::string& input : options.inputs) beds.push_back(look_at(input, wish));
  write_comparison(options.out, beds);
  fmt::print("{}\n{}\n\npage: {}/comparison.html\n", comparison_text(beds),
             beds.front().analysis.bulk.definition, options.out);
  return 0;
}

}  // namespace packbed::cli
