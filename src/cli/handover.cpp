// packbed handover: a bed of one method is where a run of another begins. A lattice bed is polished by the
// mesh packer; a mesh bed is put on a lattice.
#include <fmt/format.h>

#include <filesystem>

#include "cli/commands.hpp"
#include "io/atomic_file.hpp"
#include "io/bed.hpp"
#include "io/result_folder.hpp"
#include "math/error.hpp"

namespace packbed::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kSoftOverlap =
    0.2;  // of the thickness: the most that a case may allow, so the softest contact

/// The case without its [feed], and with the poses of a file instead.
std::string case_from_poses(const std::string& text, const std::string& poses) {
  std::string out;
  bool feed = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    if (line.starts_with("[")) feed = line.starts_with("[feed]") || line.starts_with("[[feed.");
    if (!feed) out += line;
    at = end;
  }
  return out + fmt::format("\n[feed]\nkind = \"placed\"\ncsv = \"{}\"\n", poses);
}

/// One run from the poses of `bed` into `out`.
int run_from(const PackedBed& bed, const HandoverOptions& given, const std::string& out,
             std::vector<std::string> sets) {
  fs::create_directories(given.out);
  const std::string stem = (fs::absolute(given.out) / fs::path(out).filename()).string();
  write_poses_csv(stem + "_start.csv", bed);
  write_atomically(stem + "_case.toml", case_from_poses(bed.provenance.case_text, stem + "_start.csv"));
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

}  // namespace

int handover(const HandoverOptions& options) {
  const PackedBed bed = read_bed(options.bed);
  if (bed.provenance.case_text.empty())
    throw InputError(options.bed, "a bed without its case", "a bed that packbed has packed");
  const std::string last = (fs::path(options.out) / options.to).string();
  int code = 0;
  if (options.to == "mesh") {
    // bodies of a lattice overlap by part of a cell: soft, fully damped contacts let them part without a bang
    const std::string soft = (fs::path(options.out) / "relaxed").string();
    run_from(bed, options, soft,
             {fmt::format("contact.allowed_overlap={}", kSoftOverlap), "contact.damping=1",
              fmt::format("overlap_limit={}", kSoftOverlap), "output.report=false", "output.vtk=false"});
    code = run_from(read_bed(soft), options, last, options.sets);
  } else {
    code = run_from(bed, options, last, options.sets);
  }
  CompareOptions side;
  side.inputs = {options.bed, last};
  side.out = options.out;
  side.threads = options.threads;
  compare(side);
  return code;
}

}  // namespace packbed::cli
