#include "bench/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bench/table.hpp"

namespace packbed::bench {
namespace {

// The drawing area, in pixels; the names of the series stand to its right.
constexpr double kWidth = 860, kHeight = 440, kLeft = 78, kRight = 610, kTop = 44, kBottom = 382;
constexpr const char* kInk[] = {"#0b6e99", "#c2571a", "#4d7c2f", "#8a3ffc", "#b3261e",
                                "#00857c", "#a56200", "#5b6672", "#d12771", "#1f3fae"};

/// Values to pixels.
struct Scale {
  bool log = false;
  double low = 0, high = 1;  // of the values, or of their logarithms
  double begin = 0, end = 1;

  bool shows(double v) const { return std::isfinite(v) && (!log || v > 0); }
  double at(double v) const {
    return begin + (end - begin) * ((log ? std::log10(v) : v) - low) / (high - low);
  }
};

Scale scale_for(const Axis& axis, const std::vector<double>& values, double begin, double end) {
  Scale scale{axis.log, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
              begin, end};
  for (const double v : values) {
    if (!scale.shows(v)) continue;
    scale.low = std::min(scale.low, axis.log ? std::log10(v) : v);
    scale.high = std::max(scale.high, axis.log ? std::log10(v) : v);
  }
  if (!(scale.low <= scale.high)) scale.low = 0, scale.high = 1;
  const double least = axis.log ? 0.5 : std::max(1e-12, 0.02 * std::abs(scale.high));
  const double margin = 0.05 * std::max(scale.high - scale.low, least);
  scale.low -= margin;
  scale.high += margin;
  return scale;
}

std::vector<double> ticks_of(const Scale& scale) {
  std::vector<double> ticks;
  if (scale.log) {
    const bool fine = scale.high - scale.low < 2.2;
    for (int decade = static_cast<int>(std::floor(scale.low)); decade <= scale.high; ++decade)
      for (const double m : {1.0, 2.0, 5.0}) {
        const double at = decade + std::log10(m);
        if ((fine || m == 1.0) && at >= scale.low && at <= scale.high) ticks.push_back(std::pow(10.0, at));
      }
    return ticks;
  }
  const double rough = (scale.high - scale.low) / 6, power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = power;
  for (const double m : {2.0, 5.0, 10.0})
    if (step < rough) step = m * power;
  for (double t = std::ceil(scale.low / step) * step; t <= scale.high; t += step)
    ticks.push_back(std::abs(t) < 1e-9 * step ? 0 : t);
  return ticks;
}

std::string text(double x, double y, const char* anchor, const std::string& words, const char* extra = "") {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'{}>{}</text>\n", x, y, anchor, extra,
                     escaped(words));
}

std::string axes(const Picture& p, const Scale& x, const Scale& y) {
  std::string out;
  for (const double t : ticks_of(x)) {
    out += fmt::format("<path class='grid' d='M{0:.1f} {1}V{2}'/>\n", x.at(t), kTop, kBottom);
    out += text(x.at(t), kBottom + 17, "middle", fmt::format("{:.6g}", t));
  }
  for (const double t : ticks_of(y)) {
    out += fmt::format("<path class='grid' d='M{0} {1:.1f}H{2}'/>\n", kLeft, y.at(t), kRight);
    out += text(kLeft - 7, y.at(t) + 4, "end", fmt::format("{:.6g}", t));
  }
  out += fmt::format("<rect class='frame' x='{}' y='{}' width='{}' height='{}'/>\n", kLeft, kTop,
                     kRight - kLeft, kBottom - kTop);
  out += text(0.5 * (kLeft + kRight), kBottom + 40, "middle", p.x.title);
  out += fmt::format("<text transform='translate(18 {:.1f}) rotate(-90)' text-anchor='middle'>{}</text>\n",
                     0.5 * (kTop + kBottom), escaped(p.y.title));
  return out + text(kLeft, 26, "start", p.title, " class='title'");
}

std::string draw(const Series& s, const Scale& x, const Scale& y, const char* ink) {
  std::string line, marks;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!x.shows(s.x[i]) || !y.shows(s.y[i])) continue;
    const double px = x.at(s.x[i]), py = y.at(s.y[i]);
    line += fmt::format("{:.1f},{:.1f} ", px, py);
    marks += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.6' fill='{}'/>\n", px, py, ink);
    if (i < s.error.size() && y.shows(s.y[i] - s.error[i]))
      marks += fmt::format("<path stroke='{}' d='M{:.1f} {:.1f}V{:.1f}'/>\n", ink, px,
                           y.at(s.y[i] - s.error[i]), y.at(s.y[i] + s.error[i]));
    if (i < s.label.size()) marks += text(px + 6, py - 6, "start", s.label[i], " class='label'");
  }
  if (s.joined) line = fmt::format("<polyline points='{}' stroke='{}'/>\n", line, ink);
  return (s.joined ? line : "") + marks;
}

}  // namespace

std::string to_svg(const Picture& p) {
  std::vector<double> xs, ys;
  for (const Series& s : p.series) {
    xs.insert(xs.end(), s.x.begin(), s.x.end());
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      const double error = i < s.error.size() ? s.error[i] : 0;
      ys.insert(ys.end(), {s.y[i] - error, s.y[i] + error});
    }
  }
  const Scale x = scale_for(p.x, xs, kLeft, kRight), y = scale_for(p.y, ys, kBottom, kTop);
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}'>\n"
      "<style>text{{font:12.5px system-ui,sans-serif;fill:#1b2026}}.title{{font-size:15px;font-weight:600}}"
      ".label{{font-size:11px;fill:#5b6672}}.grid{{stroke:#e1e5ea;fill:none}}.frame{{stroke:#8a94a0;fill:"
      "none}}"
      "polyline{{fill:none;stroke-width:1.6}}</style>\n<rect width='{0}' height='{1}' fill='#ffffff'/>\n",
      kWidth, kHeight);
  out += axes(p, x, y);
  for (std::size_t k = 0; k < p.series.size(); ++k) {
    const char* ink = kInk[k % std::size(kInk)];
    out += draw(p.series[k], x, y, ink);
    const double at = kTop + 12 + 19 * static_cast<double>(k);
    out += fmt::format("<circle cx='{}' cy='{}' r='4' fill='{}'/>\n", kRight + 18, at - 4, ink);
    out += text(kRight + 28, at, "start", p.series[k].name);
  }
  return out + "</svg>\n";
}

}  // namespace packbed::bench
