// The files of a study: tables, law and figures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/atomic_file.hpp"
#include "io/chart.hpp"
#include "io/size_study_lines.hpp"

namespace packbed {
namespace {

constexpr int kCurve = 100;  // points that a law is drawn with

std::string beds_csv(const Study& study) {
  std::string out = "name,seed,audit";
  for (const StudyColumn& c : kStudyColumns) out += fmt::format(",{}", c.csv);
  for (const StudyBed& b : study.beds) {
    out += fmt::format("\n{},{},{}", b.name, b.seed, b.audit);
    for (const StudyColumn& c : kStudyColumns)
      out += std::isfinite(c.value(b)) ? fmt::format(",{}", c.value(b)) : ",";
  }
  return out + '\n';
}

std::string or_nothing(double v) {
  return std::isfinite(v) ? fmt::format("{}", v) : "";
}

std::string law_csv(const Study& study) {
  std::string out = "quantity,value,half_width,least,largest,published,published_low,published_high\n";
  for (const LawLine& l : law_lines(study)) {
    const Published p = published_of(study, l.name);
    out += fmt::format("{},{},{},{},{},{},{},{}\n", l.name, or_nothing(l.value), or_nothing(l.half),
                       or_nothing(l.low), or_nothing(l.high), or_nothing(p.value), or_nothing(p.low),
                       or_nothing(p.high));
  }
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
  const Published p = published_of(study, name);
  if (!std::isfinite(p.low)) return;
  for (const double v : {p.low, p.high})
    series.push_back({{0, wide}, {v, v}, chart_ink(1), false, v == p.low ? "published range" : ""});
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
  for (const StudyColumn& c : kStudyColumns) out += fmt::format("<th>{}</th>", c.title);
  for (const StudyBed& b : study.beds) {
    out += fmt::format("</tr>\n<tr><td>{}</td><td>{}</td><td>{}</td>", html_text(b.name), b.seed, b.audit);
    for (const StudyColumn& c : kStudyColumns) out += fmt::format("<td>{}</td>", shown(c, b));
  }
  return out + "</tr></table>\n";
}

}  // namespace

void write_study(const std::string& folder, const Study& study) {
  write_atomically(folder + "/beds.csv", beds_csv(study));
  write_atomically(folder + "/law.csv", law_csv(study));
  write_atomically(
      folder + "/study.html",
      page_of("Beds of many sizes", figures(study) + "<h2>The law</h2><pre>" + html_text(law_text(study)) +
                                        "</pre>\n<h2>Beds</h2>" + table_html(study)));
}

}  // namespace packbed
