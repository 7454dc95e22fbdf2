// packbed handover: a bed of one method is where a run of another begins. A lattice bed is polished by the
// mesh packer; a mesh bed is put on a lattice.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/commands.hpp"
#include "io/atomic_file.hpp"
#include "io/bed.hpp"
#include "io/result_folder.hpp"
#include "math/error.hpp"

namespace packbed::cli {
namespace {

namespace fs = std::filesystem;

/// Bodies of a lattice overlap by part of a cell. They part without weight and friction, on fully damped
/// contacts that are as soft as a case may have and then a little stiffer: with weight the bed would flow as
/// long as there is no friction, and with friction wedged pairs would stay. Each stage begins at rest.
constexpr double kSoft[] = {0.2, 0.1};  // contact.allowed_overlap
/// Duration of a stage over the smallest thickness [s/m]: a few contact times at the 0.1 m/s that packers
/// take for bodies that only lie. Five times as long lets the bodies at the surface drift away.
constexpr double kParting = 16;

/// The case without its [feed] and its sizes, and with the poses (and scales) of a file instead.
std::string case_from_poses(const std::string& text, const std::string& poses) {
  std::string out;
  bool skip = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    if (line.starts_with("["))
      skip = line.starts_with("[feed]") || line.starts_with("[[feed.") || line.starts_with("[pellet.sizes]");
    if (!skip) out += line;
    at = end;
  }
  return out + fmt::format("\n[feed]\nkind = \"placed\"\ncsv = \"{}\"\n", poses);
}

/// One run of the case `text` from the poses of `bed` into `out`.
int run_from(const PackedBed& bed, const std::string& text, const HandoverOptions& given,
             const std::string& out, std::vector<std::string> sets) {
  fs::create_directories(given.out);
  const std::string stem = (fs::absolute(given.out) / fs::path(out).filename()).string();
  write_poses_csv(stem + "_start.csv", bed);
  write_atomically(stem + "_case.toml", case_from_poses(text, stem + "_start.csv"));
  sets.insert(sets.begin(), {"method=" + given.to, "name=" + fs::path(out).filename().string()});
  RunOptions one;
  one.case_file = stem + "_case.toml";
  one.sets = std::move(sets);
  one.out = out;
  one.threads = given.threads;
  one.quiet = given.quiet;
  one.force = given.force;
  return run(one);
}

/// What makes a run one of parting.
std::vector<std::string> parting_sets(double overlap, double thickness) {
  std::vector<std::string> sets{"gravity=0 m/s2",
                                fmt::format("stepping.duration={} ms", 1e3 * kParting * thickness),
                                "overlap_limit=1", "output.report=false", "output.vtk=false"};
  for (const char* contact : {"contact", "contact.wall"}) {
    sets.push_back(fmt::format("{}.allowed_overlap={}", contact, overlap));
    sets.push_back(fmt::format("{}.damping=1", contact));
    sets.push_back(fmt::format("{}.friction=0", contact));
  }
  return sets;
}

double smallest_thickness(const PackedBed& bed) {
  double least = bed.shapes.front()->smallest_thickness;
  for (const ShapePtr& shape : bed.shapes) least = std::min(least, shape->smallest_thickness);
  return least;
}

}  // namespace

int handover(const HandoverOptions& options) {
  const PackedBed bed = read_bed(options.bed);
  if (bed.provenance.case_text.empty())
    throw InputError(options.bed, "a bed without its case", "a bed that packbed has packed");
  const std::string last = (fs::path(options.out) / options.to).string();
  const std::string& text = bed.provenance.case_text;
  PackedBed start = bed;
  std::vector<std::string> stages;
  if (options.to == "mesh")
    for (const double overlap : kSoft) {
      stages.push_back((fs::path(options.out) / fmt::format("parting_{:g}", overlap)).string());
      run_from(start, text, options, stages.back(), parting_sets(overlap, smallest_thickness(bed)));
      start = read_bed(stages.back());
    }
  const int code = run_from(start, text, options, last, options.sets);
  CompareOptions side;
  side.inputs = {options.bed};
  side.inputs.insert(side.inputs.end(), stages.begin(), stages.end());
  side.inputs.push_back(last);
  side.out = options.out;
  side.threads = options.threads;
  compare(side);
  return code;
}

}  // namespace packbed::cli
