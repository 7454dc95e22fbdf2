// The text at the end of a run: a label column, then findings with units, wrapped to the width of a terminal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/summary.hpp"

namespace packbed {
namespace {

constexpr std::size_t kLabelWidth = 14, kLineWidth = 110;

/// "label         text", continued under itself.
std::string entry(const std::string& label, const std::string& text) {
  std::string out, line = fmt::format("  {:<{}}", label, kLabelWidth - 2);
  const std::string indent(kLabelWidth, ' ');
  bool fresh = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!fresh && line.size() + 1 + word.size() > kLineWidth) {
      out += line + '\n';
      line = indent;
      fresh = true;
    }
    line += (fresh ? "" : " ") + word;
    fresh = false;
    at = end + 1;
  }
  return out + line + '\n';
}

std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {:02d} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02d} min", whole / 3600, whole / 60 % 60);
}

std::string percent(double fraction) {
  return fmt::format("{:.3g} %", 100 * fraction);
}

std::string micro(double seconds) {
  return fmt::format("{:.3g} us", 1e6 * seconds);
}

std::string density_line(const AnalysisResult& a) {
  const BulkDensity& bulk = a.bulk;
  std::string line = fmt::format("height {:.2f} mm", 1e3 * a.bed_height_m);
  if (std::isfinite(bulk.packing_density))
    line += fmt::format(", packing density {:.4f}, spread {:.4f} (sd of the axial profile within this bed)",
                        bulk.packing_density, bulk.axial_sd);
  if (std::isfinite(bulk.exact)) line += fmt::format(", voxel-free {:.4f}", bulk.exact);
  return line;
}

std::string core_line(const CorePorosity& c) {
  std::string line;
  const auto add = [&](const char* how, double porosity) {
    if (std::isfinite(porosity))
      line += fmt::format("{}porosity {:.4f} {}", line.empty() ? "" : ", ", porosity, how);
  };
  add("exact", c.exact);
  add("from voxels", c.voxels);
  add(fmt::format("by shots (standard error {:.1e})", c.shots_error).c_str(), c.shots);
  return line.empty() ? c.definition : line + " (" + c.definition + ")";
}

/// What many sizes make of a bed; empty when all are alike and nobody knows who touches whom.
std::string mixture_line(const AnalysisResult& a) {
  std::string line;
  if (!a.sizes.empty()) line = fmt::format("{} sizes", a.sizes.size());
  if (a.segregation && std::isfinite(a.segregation->along[2]))
    line += fmt::format(", segregation {:+.4f} (+: large ones above)", a.segregation->along[2]);
  if (a.coordination)
    line += fmt::format(
        "{}{:.2f} touching pellets each{}, {} rattlers", line.empty() ? "" : ", ", a.coordination->mean,
        std::isfinite(a.coordination->core_bearing)
            ? fmt::format(" ({:.2f} in the core, rattlers aside)", a.coordination->core_bearing)
            : "",
        a.coordination->rattlers);
  return line;
}

std::string energy_line(const RunRecord& r) {
  const auto& e = r.energy;
  return fmt::format(
      "put in {:.4g} J: rubbed {:.4g}, damped {:.4g}, removed {:.4g}; left kinetic {:.2g}, potential {:.4g}, "
      "elastic {:.2g}; ledger open by {}",
      e.input, e.rubbed, e.damped, e.removed, e.kinetic, e.potential, e.elastic, percent(e.ledger_error));
}

/// The dearest phases, so that one sees where the time went.
std::string phases_line(const RunRecord& r) {
  std::vector<std::pair<std::string, double>> phases(r.time.phases_s.begin(), r.time.phases_s.end());
  std::stable_sort(phases.begin(), phases.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string line;
  for (auto [name, seconds] : phases) {
    std::replace(name.begin(), name.end(), '_', ' ');
    line += fmt::format("{}{} {:.1f} s", line.empty() ? "" : ", ", name, seconds);
  }
  return line;
}

std::string run_lines(const RunRecord& r) {
  std::string out = entry(
      "pellets", fmt::format("{} asked, {} fed, {} inside, {} escaped; {}", r.pellets.asked, r.pellets.fed,
                             r.pellets.inside, r.pellets.escaped, r.at_rest ? "at rest" : "NOT at rest"));
  out +=
      entry("overlap",
            fmt::format("at rest mean {}, largest {}; during the run largest {} (of the smallest thickness)",
                        percent(r.overlap.rest_mean), percent(r.overlap.rest_max), percent(r.overlap.peak)));
  out += entry("energy", energy_line(r));
  out += entry("walls", fmt::format("base carries {:.4g} N, side {:.4g} N of the weight {:.4g} N",
                                    r.wall.base_force_N, r.wall.side_shear_N, r.wall.weight_N));
  out +=
      entry("time",
            fmt::format("{} on {} thread{}, CPU {}; {} steps of {} for {:.3f} s simulated; memory {:.0f} MB",
                        duration(r.time.wall_s), r.threads, r.threads == 1 ? "" : "s", duration(r.time.cpu_s),
                        r.time.steps, micro(r.time.step_s), r.time.simulated_s,
                        static_cast<double>(r.peak_rss_bytes) / 1e6));
  if (!r.time.phases_s.empty()) out += entry("phases", phases_line(r));
  return out;
}

std::string audit_text(const RunRecord& r) {
  std::string out = entry("audit", r.audit_passed() ? "passed" : "FAILED");
  for (const AuditLine& line : r.audit)
    out += entry(line.passed ? "  ok" : "  FAILED", line.name + ": " + line.finding);
  return out;
}

}  // namespace

std::string summary_text(const Scene& scene, const RunRecord& r,
                         const std::optional<AnalysisResult>& analysis, const std::string& folder,
                         const std::string& report_path) {
  std::string out = fmt::format("\n{}: method {}, kernel {}, seed {}, bed {}\n", scene.name, r.method,
                                r.kernel, r.seed, r.bed_hash);
  if (analysis) {
    out += entry("bed", density_line(*analysis));
    if (!analysis->bulk.definition.empty()) out += entry("", "(" + analysis->bulk.definition + ")");
    if (analysis->core) out += entry("core", core_line(*analysis->core));
    if (const std::string mixture = mixture_line(*analysis); !mixture.empty())
      out += entry("mixture", mixture);
  }
  out += run_lines(r);
  if (!r.taps.empty()) {
    std::string densities;
    for (const TapRecord& t : r.taps)
      densities += fmt::format("{}{:.4f}", densities.empty() ? "" : ", ", t.packing_density);
    out += entry("shaken", "packing density at rest, first before: " + densities);
  }
  out += audit_text(r);
  for (const std::string& note : r.notes) out += entry("note", note);
  if (!folder.empty()) out += entry("results", folder);
  if (!report_path.empty()) out += entry("report", report_path);
  return out;
}

}  // namespace packbed
