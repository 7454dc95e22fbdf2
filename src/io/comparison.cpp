#include "io/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "io/atomic_file.hpp"
#include "io/chart.hpp"

namespace packbed {
namespace {

struct Column {
  const char *title, *csv;
  int digits;
  double (*value)(const Compared&, const Distances&);
};

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const Column kColumns[] = {
    {"density", "packing_density", 4,
     [](const Compared& b, const Distances&) { return b.analysis.bulk.packing_density; }},
    {"voxel-free", "packing_density_exact", 4,
     [](const Compared& b, const Distances&) { return b.analysis.bulk.exact; }},
    {"spread", "axial_sd", 4, [](const Compared& b, const Distances&) { return b.analysis.bulk.axial_sd; }},
    {"difference", "density_difference", 4, [](const Compared&, const Distances& d) { return d.bulk; }},
    {"axial RMS", "axial_rms", 4, [](const Compared&, const Distances& d) { return d.axial; }},
    {"radial RMS", "radial_rms", 4, [](const Compared&, const Distances& d) { return d.radial; }},
    {"KS", "orientation_ks", 4, [](const Compared&, const Distances& d) { return d.orientation.distance; }},
    {"KS 5 %", "orientation_ks_limit", 4,
     [](const Compared&, const Distances& d) { return d.orientation.limit_5_percent; }},
    {"overlap %", "overlap_mean_percent", 2,
     [](const Compared& b, const Distances&) { return b.record ? 100 * b.record->overlap.rest_mean : kNaN; }},
    {"largest %", "overlap_largest_percent", 2,
     [](const Compared& b, const Distances&) { return b.record ? 100 * b.record->overlap.rest_max : kNaN; }},
    {"CPU s", "cpu_s", 1,
     [](const Compared& b, const Distances&) { return b.record ? b.record->time.cpu_s : kNaN; }},
    {"MB", "peak_rss_MB", 0,
     [](const Compared& b, const Distances&) {
       return b.record ? static_cast<double>(b.record->peak_rss_bytes) / 1e6 : kNaN;
     }},
};

std::string number(double v, int digits) {
  return std::isfinite(v) ? fmt::format("{:.{}f}", v, digits) : "-";
}

std::string method_of(const Compared& b) {
  return b.record ? b.record->method : "-";
}

std::string audit_of(const Compared& b) {
  return !b.record ? "-" : b.record->audit_passed() ? "passed" : "failed";
}

const std::vector<double>& curve(const Profile& p) {
  return p.density.empty() ? p.exact : p.density;
}

std::string table_csv(const std::vector<Compared>& beds) {
  std::string out = "name,method,audit";
  for (const Column& c : kColumns) out += fmt::format(",{}", c.csv);
  out += '\n';
  for (const Compared& b : beds) {
    const Distances d = distances(beds.front().analysis, b.analysis);
    out += fmt::format("{},{},{}", b.name, method_of(b), audit_of(b));
    for (const Column& c : kColumns) {
      const double v = c.value(b, d);
      out += std::isfinite(v) ? fmt::format(",{}", v) : ",";
    }
    out += '\n';
  }
  return out;
}

std::string curves_csv(const std::vector<Compared>& beds, const Profile AnalysisResult::*which) {
  std::string out = "name,x_dp,density\n";
  for (const Compared& b : beds) {
    const Profile& p = b.analysis.*which;
    const std::vector<double>& y = curve(p);
    for (std::size_t i = 0; i < y.size(); ++i)
      out += fmt::format("{},{:.6g},{}\n", b.name, p.x_dp[i],
                         std::isfinite(y[i]) ? fmt::format("{:.6g}", y[i]) : "");
  }
  return out;
}

std::string orientation_csv(const std::vector<Compared>& beds) {
  std::string out = "name,from_deg,to_deg,fraction,isotropic\n";
  for (const Compared& b : beds) {
    if (!b.analysis.orientation) continue;
    const Orientation& o = *b.analysis.orientation;
    for (std::size_t k = 0; k < o.fraction.size(); ++k)
      out += fmt::format("{},{:g},{:g},{:.6g},{:.6g}\n", b.name, o.from_deg[k], o.to_deg[k], o.fraction[k],
                         o.isotropic[k]);
  }
  return out;
}

// --- the page ----------------------------------------------------------------------------------------------

std::string table_html(const std::vector<Compared>& beds) {
  std::string out = "<table><tr><th></th><th>bed</th><th>method</th><th>audit</th>";
  for (const Column& c : kColumns) out += fmt::format("<th>{}</th>", c.title);
  out += "</tr>\n";
  for (std::size_t n = 0; n < beds.size(); ++n) {
    const Compared& b = beds[n];
    const Distances d = distances(beds.front().analysis, b.analysis);
    out += fmt::format("<tr><td style='background:{}'></td><td>{}</td><td>{}</td><td>{}</td>", chart_ink(n),
                       html_text(b.name), method_of(b), audit_of(b));
    for (const Column& c : kColumns) out += fmt::format("<td>{}</td>", number(c.value(b, d), c.digits));
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::vector<Series> lines_of(const std::vector<Compared>& beds, const Profile AnalysisResult::*which) {
  std::vector<Series> lines;
  for (const Compared& b : beds)
    lines.push_back({(b.analysis.*which).x_dp, curve(b.analysis.*which), chart_ink(lines.size())});
  return lines;
}

std::vector<Series> histograms(const std::vector<Compared>& beds) {
  std::vector<Series> lines;
  for (const Compared& b : beds) {
    Series line{{}, {}, chart_ink(lines.size())};
    if (b.analysis.orientation)
      for (std::size_t k = 0; k < b.analysis.orientation->fraction.size(); ++k) {
        line.x.push_back((b.analysis.orientation->from_deg[k] + b.analysis.orientation->to_deg[k]) / 2);
        line.y.push_back(b.analysis.orientation->fraction[k]);
      }
    lines.push_back(line);
  }
  return lines;
}

std::string page(const std::vector<Compared>& beds) {
  return page_of(
      "Beds side by side",
      table_html(beds) +
          "<p>Differences and distances are from the first bed. RMS: of two density curves over the distance "
          "in pellet diameters. KS: largest difference of the two distributions of the angle between pellet "
          "axis and vertical; beds of one distribution exceed the limit beside it in one case of "
          "twenty. Overlap: of the bodies at rest, in the mean of the touching pairs and the largest, of the "
          "smallest thickness.</p>\n" +
          chart("Packing density along the height", "height / dp", lines_of(beds, &AnalysisResult::axial)) +
          chart("Packing density from the wall", "distance from the wall / dp",
                lines_of(beds, &AnalysisResult::radial)) +
          chart("Orientation", "angle between axis and vertical [deg]; share in classes of 10 deg",
                histograms(beds)));
}

}  // namespace

std::string comparison_text(const std::vector<Compared>& beds) {
  std::size_t width = 4;
  for (const Compared& b : beds) width = std::max(width, b.name.size());
  std::string out = fmt::format("{:<{}}  {:<8}  {:<6}", "bed", width, "method", "audit");
  for (const Column& c : kColumns) out += fmt::format("  {:>10}", c.title);
  out += '\n';
  for (const Compared& b : beds) {
    const Distances d = distances(beds.front().analysis, b.analysis);
    out += fmt::format("{:<{}}  {:<8}  {:<6}", b.name, width, method_of(b), audit_of(b));
    for (const Column& c : kColumns) out += fmt::format("  {:>10}", number(c.value(b, d), c.digits));
    out += '\n';
  }
  return out;
}

void write_comparison(const std::string& folder, const std::vector<Compared>& beds) {
  write_atomically(folder + "/comparison.csv", table_csv(beds));
  write_atomically(folder + "/axial.csv", curves_csv(beds, &AnalysisResult::axial));
  write_atomically(folder + "/radial.csv", curves_csv(beds, &AnalysisResult::radial));
  write_atomically(folder + "/orientation.csv", orientation_csv(beds));
  write_atomically(folder + "/comparison.html", page(beds));
}

}  // namespace packbed
