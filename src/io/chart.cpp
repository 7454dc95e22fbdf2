#include "io/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace packbed {
namespace {

constexpr const char* kInk[] = {"#1b6ca8", "#c8553d", "#3a7d44", "#8e5ba6", "#b8860b", "#4a4a4a"};
constexpr double kWidth = 860, kHeight = 260, kEdge = 44;

/// From data to the picture.
struct Frame {
  double wide = 0, low = 0, high = -std::numeric_limits<double>::infinity();

  double x(double v) const { return kEdge + v / wide * (kWidth - 2 * kEdge); }
  double y(double v) const { return kHeight - kEdge - (v - low) / (high - low) * (kHeight - 2 * kEdge); }
};

Frame frame_of(const std::vector<Series>& series, double from) {
  Frame f;
  f.low = from;
  for (const Series& s : series)
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (std::isfinite(s.y[i])) {
        f.wide = std::max(f.wide, s.x[i]);
        f.low = std::min(f.low, s.y[i]);
        f.high = std::max(f.high, s.y[i]);
      }
  return f;
}

std::string axes(const Frame& f) {
  std::string out = fmt::format("<path class='axes' d='M{:.1f} {:.1f}V{:.1f}H{:.1f}'/>", f.x(0), f.y(f.high),
                                f.y(f.low), f.x(f.wide));
  for (int k = 0; k <= 4; ++k) {
    const double across = f.wide * k / 4, up = f.low + (f.high - f.low) * k / 4;
    out += fmt::format(
        "<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:.3g}</text><text x='{:.1f}' y='{:.1f}' "
        "text-anchor='end'>{:.3g}</text>",
        f.x(across), kHeight - kEdge + 16, across, kEdge - 6, f.y(up) + 4, up);
  }
  return out;
}

std::string drawn(const Series& s, const Frame& f) {
  std::string points, dots;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!std::isfinite(s.y[i])) continue;
    points += fmt::format("{:.1f},{:.1f} ", f.x(s.x[i]), f.y(s.y[i]));
    dots +=
        fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.2' fill='{}'/>", f.x(s.x[i]), f.y(s.y[i]), s.ink);
  }
  return s.dots ? dots : fmt::format("<polyline stroke='{}' points='{}'/>", s.ink, points);
}

std::string legend(const std::vector<Series>& series) {
  std::string out;
  for (const Series& s : series)
    if (!s.name.empty())
      out += fmt::format("<span><b style='color:{}'>{}</b> {}</span> ", s.ink, s.dots ? "&#9679;" : "&#9473;",
                         html_text(s.name));
  return out.empty() ? "" : "<p class='legend'>" + out + "</p>\n";
}

}  // namespace

const char* chart_ink(std::size_t n) {
  return kInk[n % std::size(kInk)];
}

std::string html_text(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

std::string chart(const std::string& title, const std::string& x_label, const std::vector<Series>& series,
                  double from) {
  const Frame f = frame_of(series, from);
  if (!(f.wide > 0) || !(f.high > f.low)) return "";
  std::string out = fmt::format("<h2>{}</h2>{}<svg viewBox='0 0 {:g} {:g}' role='img'>", html_text(title),
                                legend(series), kWidth, kHeight) +
                    axes(f);
  for (const Series& s : series) out += drawn(s, f);
  return out + fmt::format("<text x='{:g}' y='{:g}' text-anchor='middle'>{}</text></svg>\n", kWidth / 2,
                           kHeight - 6, html_text(x_label));
}

std::string page_of(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!doctype html><html lang='en'><meta charset='utf-8'><title>{0}</title><style>"
      "body{{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem}}"
      "table{{border-collapse:collapse;font-size:13px}}td,th{{padding:.2rem .6rem;text-align:right;"
      "border-bottom:1px solid #ddd}}td:first-child{{padding-left:0}}svg{{width:100%}}"
      "polyline{{fill:none;stroke-width:1.6}}.axes{{fill:none;stroke:#888}}text{{font-size:11px;fill:#444}}"
      ".legend span{{margin-right:1.5rem}}</style><body><h1>{0}</h1>\n{1}</body></html>\n",
      html_text(title), body);
}

}  // namespace packbed
