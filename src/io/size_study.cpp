#include "io/size_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "io/chart.hpp"
#include "io/csv_table.hpp"
#include "io/result_folder.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

using Json = nlohmann::json;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kEqual = 1 - 1e-9;  // ratio of sizes
constexpr int kCurve = 100;          // points that a law is drawn with

double number_at(const Json& json, const Json::json_pointer& at) {
  return json.contains(at) && json.at(at).is_number() ? json.at(at).get<double>() : kNaN;
}

StudyBed read_bed_of_study(const std::string& input) {
  const std::string path = file_in(input, result_file::kSummary);
  try {
    const Json s = Json::parse(read_file(path));
    const auto number = [&](const char* at) { return number_at(s, Json::json_pointer(at)); };
    StudyBed bed;
    bed.name = s.at("case").get<std::string>();
    bed.audit = s.at("audit").get<std::string>();
    bed.seed = s.at("seed").get<unsigned long long>();
    bed.pellets = s.at("/pellets/inside"_json_pointer).get<int>();
    bed.smallest_m = number("/bed/smallest_m");
    bed.largest_m = number("/bed/largest_m");
    bed.height_m = number("/bed/height_m");
    bed.porosity = number("/bed/core_porosity");
    bed.shots = number("/bed/core/shots");
    bed.shots_error = number("/bed/core/shots_error");
    bed.segregation = number("/bed/segregation");
    bed.coordination = number("/bed/coordination/core_bearing");
    bed.cpu_s = number("/time/cpu_s");
    bed.wall_s = number("/time/wall_s");
    for (const Json& row : s.value("sizes", Json::array()))
      bed.sizes.push_back({row.at("diameter_m").get<double>(), row.at("volume").get<double>()});
    if (!(bed.smallest_m > 0) || !(bed.largest_m > 0))
      throw InputError(path, "no size of the pellets", "the summary of a bed that was analysed");
    return bed;
  } catch (const Json::exception& e) {
    throw InputError(path, e.what(), "the summary.json of a finished run");
  }
}

struct Column {
  const char *title, *csv, *format;
  double (*value)(const StudyBed&);
};

const Column kColumns[] = {
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
std::string shown(const Column& c, const StudyBed& b) {
  const double v = c.value(b) * (std::string_view(c.title).ends_with("mm") ? 1e3 : 1);
  return std::isfinite(v) ? fmt::format(fmt::runtime(c.format), v) : "-";
}

std::string beds_csv(const Study& study) {
  std::string out = "name,seed,audit";
  for (const Column& c : kColumns) out += fmt::format(",{}", c.csv);
  for (const StudyBed& b : study.beds) {
    out += fmt::format("\n{},{},{}", b.name, b.seed, b.audit);
    for (const Column& c : kColumns) out += std::isfinite(c.value(b)) ? fmt::format(",{}", c.value(b)) : ",";
  }
  return out + '\n';
}

/// One quantity of the law: fitted value, half of its interval, published value.
struct LawLine {
  std::string name;
  double value = kNaN, half = kNaN, published = kNaN, low = kNaN, high = kNaN;
};

double published_value(const Study& study, const std::string& name) {
  const auto found = study.published.find(name);
  return found == study.published.end() ? kNaN : found->second.value;
}

double porosity_of_equal(const StudyBed& b) {
  return b.ratio() > kEqual ? b.porosity : kNaN;
}

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
  LawLine line{name};
  if (n > 0) line = {name, sum / n, kNaN, kNaN, least, most};
  line.published = published_value(study, name);
  return line;
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
    line.published = published_value(study, names[k]);
    lines.push_back(line);
  }
  lines.push_back({"sd", study.law ? study.law->sd : kNaN, kNaN, published_value(study, "sd"), kNaN, kNaN});
  lines.push_back(range_line(study, "monodisperse", porosity_of_equal));
  lines.push_back(range_line(study, "segregation", [](const StudyBed& b) { return b.segregation; }));
  return lines;
}

std::string or_nothing(double v) {
  return std::isfinite(v) ? fmt::format("{}", v) : "";
}

std::string law_csv(const Study& study) {
  std::string out = "quantity,value,half_width,least,largest,published,published_low,published_high\n";
  for (const LawLine& l : law_lines(study)) {
    const auto found = study.published.find(l.name);
    const Published p = found == study.published.end() ? Published{kNaN, kNaN, kNaN} : found->second;
    out += fmt::format("{},{},{},{},{},{},{},{}\n", l.name, or_nothing(l.value), or_nothing(l.half),
                       or_nothing(l.low), or_nothing(l.high), or_nothing(p.value), or_nothing(p.low),
                       or_nothing(p.high));
  }
  return out;
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
  const auto found = study.published.find(l.name);
  if (found == study.published.end()) return out;
  out += "   published:";
  if (std::isfinite(found->second.value)) out += fmt::format(" {:g}", found->second.value);
  if (std::isfinite(found->second.low))
    out += fmt::format(" ({:g} to {:g})", found->second.low, found->second.high);
  return out;
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

/// One dot a bed.
Series dots(const Study& study, double (*x)(const StudyBed&), double (*y)(const StudyBed&)) {
  Series s{{}, {}, chart_ink(0), true, "this study"};
  for (const StudyBed& b : study.beds) {
    s.x.push_back(x(b));
    s.y.push_back(y(b));
  }
  return s;
}

double millimetres(const StudyBed& b) {
  return 1e3 * b.smallest_m;
}
double ratio(const StudyBed& b) {
  return b.ratio();
}
double porosity(const StudyBed& b) {
  return b.porosity;
}

Series mean_by_size(const Study& study) {
  Series s{{}, {}, chart_ink(0), false, "mean of each size"};
  for (std::size_t i = 0; i < study.beds.size();) {
    const double size = study.beds[i].smallest_m;
    double sum = 0, n = 0;
    for (; i < study.beds.size() && study.beds[i].smallest_m <= size * (1 + 1e-9); ++i)
      if (std::isfinite(study.beds[i].porosity)) sum += study.beds[i].porosity, ++n;
    s.x.push_back(1e3 * size);
    s.y.push_back(sum / n);
  }
  return s;
}

/// What the packing model says of the sizes of the study, in the middle of the beds of each.
Series model_curve(const Study& study) {
  Series s{{}, {}, chart_ink(2), false, "linear packing model"};
  for (const StudyBed& b : study.beds)
    if (std::isfinite(b.model)) {
      s.x.push_back(b.ratio());
      s.y.push_back(b.model);
    }
  return s;
}

/// The law from a hundredth upwards; `scale` is what x is shown in.
Series curve(const PowerLaw& law, double scale, std::size_t ink, const std::string& name) {
  Series s{{}, {}, chart_ink(ink), false, name};
  for (int i = 0; i <= kCurve; ++i) {
    const double x = std::max(1e-3, static_cast<double>(i) / kCurve);
    s.x.push_back(scale * x);
    s.y.push_back(law.at(x));
  }
  return s;
}

/// The ends of a published range, as lines across.
void add_range(std::vector<Series>& series, const Study& study, const std::string& name, double wide) {
  const auto found = study.published.find(name);
  if (found == study.published.end() || !std::isfinite(found->second.low)) return;
  for (const double v : {found->second.low, found->second.high})
    series.push_back(
        {{0, wide}, {v, v}, chart_ink(1), false, v == found->second.low ? "published range" : ""});
}

std::optional<PowerLaw> published_law(const Study& study) {
  PowerLaw law;
  const char* names[] = {"a", "b", "n"};
  for (std::size_t k = 0; k < 3; ++k) law.value[k] = published_value(study, names[k]);
  return std::isfinite(law.value[0] + law.value[1] + law.value[2]) ? std::optional(law) : std::nullopt;
}

std::string figures(const Study& study) {
  double wide = 0, largest = 0;
  for (const StudyBed& b : study.beds) {
    wide = std::max(wide, millimetres(b));
    largest = std::max(largest, 1e3 * b.largest_m);
  }
  std::vector<Series> third{dots(study, millimetres, [](const StudyBed& b) { return b.segregation; })};
  add_range(third, study, "segregation", wide);
  std::vector<Series> fourth{dots(study, millimetres, porosity), mean_by_size(study)};
  std::vector<Series> fifth{dots(study, ratio, porosity)};
  if (study.law) fifth.push_back(curve(*study.law, 1, 0, "fitted law"));
  if (const Series model = model_curve(study); model.x.size() > 1) fifth.push_back(model);
  if (const auto law = published_law(study)) {
    fourth.push_back(curve(*law, largest, 1, "published law"));
    fifth.push_back(curve(*law, 1, 1, "published law"));
  }
  add_range(fourth, study, "monodisperse", wide);
  constexpr double kFrom = 0.15;  // of the porosity axis
  return chart("Segregation of sizes (figure 3)", "diameter of the smallest spheres [mm]", third) +
         chart("Porosity of the core (figure 4)", "diameter of the smallest spheres [mm]", fourth, kFrom) +
         chart("The fractal law (figure 5)", "smallest over largest diameter", fifth, kFrom);
}

std::string table_html(const Study& study) {
  std::string out = "<table><tr><th>bed</th><th>seed</th><th>audit</th>";
  for (const Column& c : kColumns) out += fmt::format("<th>{}</th>", c.title);
  for (const StudyBed& b : study.beds) {
    out += fmt::format("</tr>\n<tr><td>{}</td><td>{}</td><td>{}</td>", html_text(b.name), b.seed, b.audit);
    for (const Column& c : kColumns) out += fmt::format("<td>{}</td>", shown(c, b));
  }
  return out + "</tr></table>\n";
}

std::optional<PowerLaw> fit_with_published_n(const Study& study, const std::vector<double>& x,
                                             const std::vector<double>& y) {
  const double n = published_value(study, "n");
  if (!std::isfinite(n)) return {};
  try {
    return fit_power_law_of(n, x, y);
  } catch (const InputError&) {
    return {};  // too few, as the law's own message says
  }
}

}  // namespace

std::vector<StudyBed> read_study(const std::vector<std::string>& folders) {
  std::vector<StudyBed> beds;
  for (const std::string& folder : folders) beds.push_back(read_bed_of_study(folder));
  std::stable_sort(beds.begin(), beds.end(), [](const StudyBed& a, const StudyBed& b) {
    return std::pair(a.smallest_m, a.pellets) < std::pair(b.smallest_m, b.pellets);
  });
  return beds;
}

std::map<std::string, Published> read_published(const std::string& path) {
  const CsvTable table = read_csv_table(path, "published numbers");
  if (table.header.cells != std::vector<std::string>{"quantity", "value", "low", "high"})
    throw InputError(table.header.where, fmt::format("{}", fmt::join(table.header.cells, ",")),
                     "quantity,value,low,high");
  std::map<std::string, Published> out;
  for (const CsvLine& line : table.lines) {
    const auto number = [&](std::size_t i) {
      return line.cells[i].empty() ? kNaN : csv_number(line.cells[i], line.where);
    };
    out[line.cells[0]] = {number(1), number(2), number(3)};
  }
  return out;
}

Study make_study(std::vector<StudyBed> beds, std::map<std::string, Published> published) {
  Study study{std::move(beds), std::move(published), {}, "", {}};
  const double alone = range_line(study, "monodisperse", porosity_of_equal).value;
  for (StudyBed& b : study.beds)
    b.model = b.ratio() > kEqual ? alone : std::isfinite(alone) ? mixture_porosity(b.sizes, alone) : kNaN;
  std::vector<double> x, y;
  for (const StudyBed& b : study.beds)
    if (std::isfinite(b.porosity)) {
      x.push_back(b.ratio());
      y.push_back(b.porosity);
    }
  try {
    study.law = fit_power_law(x, y);
  } catch (const InputError& e) {
    study.no_law = e.what();
    study.with_published_n = fit_with_published_n(study, x, y);
  }
  return study;
}

std::string study_text(const Study& study) {
  std::size_t width = 4;
  for (const StudyBed& b : study.beds) width = std::max(width, b.name.size());
  std::string out = fmt::format("{:<{}}  {:>5}  {:<6}", "bed", width, "seed", "audit");
  for (const Column& c : kColumns) out += fmt::format("  {:>11}", c.title);
  for (const StudyBed& b : study.beds) {
    out += fmt::format("\n{:<{}}  {:>5}  {:<6}", b.name, width, b.seed, b.audit);
    for (const Column& c : kColumns) out += fmt::format("  {:>11}", shown(c, b));
  }
  return out + "\n\n" + law_text(study);
}

void write_study(const std::string& folder, const Study& study) {
  write_atomically(folder + "/beds.csv", beds_csv(study));
  write_atomically(folder + "/law.csv", law_csv(study));
  write_atomically(
      folder + "/study.html",
      page_of("Beds of many sizes", figures(study) + "<h2>The law</h2><pre>" + html_text(law_text(study)) +
                                        "</pre>\n<h2>Beds</h2>" + table_html(study)));
}

}  // namespace packbed
