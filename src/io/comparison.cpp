#include "io/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "io/atomic_file.hpp"

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

constexpr const char* kInk[] = {"#1b6ca8", "#c8553d", "#3a7d44", "#8e5ba6", "#b8860b", "#4a4a4a"};
constexpr double kWidth = 860, kHeight = 260, kEdge = 40;

struct Line {
  std::vector<double> x, y;
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

/// Curves in one frame; x as far as the longest, y from 0 to the highest.
std::string chart(const std::string& title, const std::string& axis, const std::vector<Line>& lines) {
  double wide = 0, high = 0;
  for (const Line& l : lines)
    for (std::size_t i = 0; i < l.x.size(); ++i)
      if (std::isfinite(l.y[i])) wide = std::max(wide, l.x[i]), high = std::max(high, l.y[i]);
  if (!(wide > 0) || !(high > 0)) return "";
  const auto px = [&](double x) { return kEdge + x / wide * (kWidth - 2 * kEdge); };
  const auto py = [&](double y) { return kHeight - kEdge - y / high * (kHeight - 2 * kEdge); };
  std::string out = fmt::format(
      "<h2>{}</h2><svg viewBox='0 0 {:g} {:g}' role='img'><path class='axes' d='M{:.1f} "
      "{:.1f}V{:.1f}H{:.1f}'/>",
      title, kWidth, kHeight, px(0), py(high), py(0), px(wide));
  for (int k = 0; k <= 4; ++k)
    out += fmt::format(
        "<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:.3g}</text><text x='{:.1f}' y='{:.1f}' "
        "text-anchor='end'>{:.3g}</text>",
        px(wide * k / 4), kHeight - kEdge + 16, wide * k / 4, kEdge - 6, py(high * k / 4) + 4, high * k / 4);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    std::string points;
    for (std::size_t i = 0; i < lines[n].x.size(); ++i)
      if (std::isfinite(lines[n].y[i]))
        points += fmt::format("{:.1f},{:.1f} ", px(lines[n].x[i]), py(lines[n].y[i]));
    out += fmt::format("<polyline stroke='{}' points='{}'/>", kInk[n % std::size(kInk)], points);
  }
  return out + fmt::format("<text x='{:g}' y='{:g}' text-anchor='middle'>{}</text></svg>\n", kWidth / 2,
                           kHeight - 6, axis);
}

std::string table_html(const std::vector<Compared>& beds) {
  std::string out = "<table><tr><th></th><th>bed</th><th>method</th><th>audit</th>";
  for (const Column& c : kColumns) out += fmt::format("<th>{}</th>", c.title);
  out += "</tr>\n";
  for (std::size_t n = 0; n < beds.size(); ++n) {
    const Compared& b = beds[n];
    const Distances d = distances(beds.front().analysis, b.analysis);
    out += fmt::format("<tr><td style='background:{}'></td><td>{}</td><td>{}</td><td>{}</td>",
                       kInk[n % std::size(kInk)], escaped(b.name), method_of(b), audit_of(b));
    for (const Column& c : kColumns) out += fmt::format("<td>{}</td>", number(c.value(b, d), c.digits));
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::vector<Line> lines_of(const std::vector<Compared>& beds, const Profile AnalysisResult::*which) {
  std::vector<Line> lines;
  for (const Compared& b : beds) lines.push_back({(b.analysis.*which).x_dp, curve(b.analysis.*which)});
  return lines;
}

std::vector<Line> histograms(const std::vector<Compared>& beds) {
  std::vector<Line> lines;
  for (const Compared& b : beds) {
    Line line;
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
  return "<!doctype html><html lang='en'><meta charset='utf-8'><title>beds side by side</title><style>"
         "body{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem}"
         "table{border-collapse:collapse;font-size:13px}td,th{padding:.2rem "
         ".6rem;text-align:right;border-bottom:1px "
         "solid #ddd}td:first-child{width:.5rem;padding:0}svg{width:100%}polyline{fill:none;stroke-width:1.6}"
         ".axes{fill:none;stroke:#888}text{font-size:11px;fill:#444}</style><body><h1>Beds side by "
         "side</h1>\n" +
         table_html(beds) +
         "<p>Differences and distances are from the first bed. RMS: of two density curves over the distance "
         "in "
         "pellet diameters. KS: largest difference of the two distributions of the angle between pellet axis "
         "and "
         "vertical; beds of one distribution exceed the limit beside it in one case of twenty. Overlap: of "
         "the bodies at "
         "rest, in the mean of the touching pairs and the largest, of the smallest thickness.</p>\n" +
         chart("Packing density along the height", "height / dp", lines_of(beds, &AnalysisResult::axial)) +
         chart("Packing density from the wall", "distance from the wall / dp",
               lines_of(beds, &AnalysisResult::radial)) +
         chart("Orientation", "angle between axis and vertical [deg]; share in classes of 10 deg",
               histograms(beds)) +
         "</body></html>\n";
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
