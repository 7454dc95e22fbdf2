#include "io/size_study_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace packbed {
namespace {

constexpr double kNaN = LawLine::kNone;

/// Mean, and half of the way from the least to the largest.
LawLine range_line(const Study& study, const std::string& name, double (*value)(const StudyBed&)) {
  double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0, n = 0;
  for (const StudyBed& b : study.beds)
    if (const double v = value(b); std::isfinite(v)) {
      least = std::min(least, v);
      most = std::max(most, v);
      sum += v;
      ++n;
    }
  return n > 0 ? LawLine{name, sum / n, kNaN, least, most} : LawLine{name};
}

std::string line_text(const Study& study, const LawLine& l) {
  std::string out = fmt::format("{:<13}", l.name);
  if (!std::isfinite(l.value))
    out += " -";
  else if (std::isfinite(l.low))
    out += fmt::format(" {:+.4f} ({:+.4f} to {:+.4f})", l.value, l.low, l.high);
  else
    out += fmt::format(" {:.4f}", l.value);
  if (std::isfinite(l.half)) out += fmt::format(" +- {:.4f}", l.half);
  if (!study.published.contains(l.name)) return out;
  const Published p = published_of(study, l.name);
  out += "   published:";
  if (std::isfinite(p.value)) out += fmt::format(" {:g}", p.value);
  if (std::isfinite(p.low)) out += fmt::format(" ({:g} to {:g})", p.low, p.high);
  return out;
}

}  // namespace

Published published_of(const Study& study, const std::string& name) {
  const auto found = study.published.find(name);
  return found == study.published.end() ? Published{kNaN, kNaN, kNaN} : found->second;
}

double published_value(const Study& study, const std::string& name) {
  return published_of(study, name).value;
}

LawLine of_equal_pellets(const Study& study) {
  return range_line(study, "monodisperse",
                    [](const StudyBed& b) { return b.of_equal_pellets() ? b.porosity : kNaN; });
}

const std::vector<StudyColumn> kStudyColumns{
    {"Dmin mm", "smallest_m", "{:.2f}", [](const StudyBed& b) { return b.smallest_m; }},
    {"Dmin/Dmax", "ratio", "{:.4f}", [](const StudyBed& b) { return b.ratio(); }},
    {"pellets", "pellets", "{:.0f}", [](const StudyBed& b) { return static_cast<double>(b.pellets); }},
    {"height mm", "height_m", "{:.1f}", [](const StudyBed& b) { return b.height_m; }},
    {"porosity", "core_porosity", "{:.4f}", [](const StudyBed& b) { return b.porosity; }},
    {"by shots", "core_porosity_shots", "{:.4f}", [](const StudyBed& b) { return b.shots; }},
    {"by model", "core_porosity_model", "{:.4f}", [](const StudyBed& b) { return b.model; }},
    {"their error", "shots_error", "{:.1e}", [](const StudyBed& b) { return b.shots_error; }},
    {"segregation", "segregation", "{:+.4f}", [](const StudyBed& b) { return b.segregation; }},
    {"contacts", "core_coordination", "{:.2f}", [](const StudyBed& b) { return b.coordination; }},
    {"CPU s", "cpu_s", "{:.0f}", [](const StudyBed& b) { return b.cpu_s; }},
    {"wall s", "wall_s", "{:.0f}", [](const StudyBed& b) { return b.wall_s; }},
};

/// As people read it: lengths in millimetres.
std::string shown(const StudyColumn& c, const StudyBed& b) {
  const double v = c.value(b) * (std::string_view(c.title).ends_with("mm") ? 1e3 : 1);
  return std::isfinite(v) ? fmt::format(fmt::runtime(c.format), v) : "-";
}

std::vector<LawLine> law_lines(const Study& study) {
  std::vector<LawLine> lines;
  const char* names[] = {"a", "b", "n"};
  for (std::size_t k = 0; k < 3; ++k) {
    LawLine line{names[k]};
    if (study.law) {
      line.value = study.law->value[k];
      line.half = study.law->half_width[k];
    }
    lines.push_back(line);
  }
  lines.push_back({"sd", study.law ? study.law->sd : kNaN});
  lines.push_back(of_equal_pellets(study));
  lines.push_back(range_line(study, "segregation", [](const StudyBed& b) { return b.segregation; }));
  return lines;
}

std::string law_text(const Study& study) {
  std::string out = "porosity of the core = a + b (Dmin / Dmax)^n";
  out += study.law ? fmt::format(", {} beds, intervals of {:.0f} %\n", study.law->points,
                                 100 * study.law->confidence)
                   : fmt::format(": not fitted ({})\n", study.no_law);
  for (const LawLine& l : law_lines(study)) out += line_text(study, l) + '\n';
  if (const auto& law = study.with_published_n)
    out += fmt::format("with n = {:g} as published: a {:.4f} +- {:.4f}, b {:.4f} +- {:.4f}, sd {:.4f}\n",
                       law->value[2], law->value[0], law->half_width[0], law->value[1], law->half_width[1],
                       law->sd);
  return out;
}

std::string study_text(const Study& study) {
  std::size_t width = 4;
  for (const StudyBed& b : study.beds) width = std::max(width, b.name.size());
  std::string out = fmt::format("{:<{}}  {:>5}  {:<6}", "bed", width, "seed", "audit");
  for (const StudyColumn& c : kStudyColumns) out += fmt::format("  {:>11}", c.title);
  for (const StudyBed& b : study.beds) {
    out += fmt::format("\n{:<{}}  {:>5}  {:<6}", b.name, width, b.seed, b.audit);
    for (const StudyColumn& c : kStudyColumns) out += fmt::format("  {:>11}", shown(c, b));
  }
  return out + "\n\n" + law_text(study);
}

}  // namespace packbed
