// Whole beds: what the knobs of a run do to the bed, over seeds.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "analysis/analyse.hpp"
#include "bench/bench.hpp"
#include "bench/pour.hpp"
#include "bench/statistics.hpp"

namespace packbed::bench {
namespace {

struct Change {
  std::string knob;
  double value;
  std::string label;  // of the picture; "": the number
  std::function<void(Scene&)> apply;
};

void add_change(std::vector<Change>& all, const std::string& knob, const std::vector<double>& values,
                const std::function<void(Scene&, double)>& apply) {
  for (const double v : values) all.push_back({knob, v, "", [=](Scene& s) { apply(s, v); }});
}

/// The case as it stands first, then one knob at a time.
std::vector<Change> changes(bool quick) {
  std::vector<Change> all{{"as it stands", 0, "case", [](Scene&) {}}};
  const auto some = [&](std::vector<double> values) {
    if (quick) values.erase(values.begin() + 1, values.end() - 1);
    return values;
  };
  all.push_back({"sleep", 0, "off", [](Scene& s) { s.stepping.sleep = false; }});
  add_change(all, "sleep_displacement", some({1e-4, 3e-4, 3e-3, 1e-2}),
             [](Scene& s, double v) { s.stepping.sleep_displacement = v; });
  add_change(all, "steps_per_contact", some({10, 14, 28, 40}),
             [](Scene& s, double v) { s.stepping.steps_per_contact = v; });
  add_change(all, "allowed_overlap", some({0.015, 0.03, 0.06, 0.09}), [](Scene& s, double v) {
    s.pellet_contact.allowed_overlap = s.wall_contact.allowed_overlap = v;
  });
  if (!quick) all.push_back({"kernel field", 0, "field", [](Scene& s) { s.kernel = "field"; }});
  return all;
}

struct Column {
  std::string name;
  double PouredBed::*value;
};
const std::vector<Column> kColumns = {{"packing density", &PouredBed::density},
                                      {"mean pellet height [mm]", &PouredBed::mean_height_mm},
                                      {"overlap at rest, mean [% of thickness]", &PouredBed::rest_mean},
                                      {"overlap at rest, largest [% of thickness]", &PouredBed::rest_max},
                                      {"overlap, peak [% of thickness]", &PouredBed::peak},
                                      {"energy ledger error [%]", &PouredBed::ledger},
                                      {"CPU [s]", &PouredBed::cpu_s}};

/// Mean difference from the first change, seed by seed: the same feed in both, so much of the scatter falls
/// out.
Mean paired(const std::vector<PouredBed>& beds, const std::vector<PouredBed>& base,
            double PouredBed::*value) {
  std::vector<double> values;
  for (std::size_t i = 0; i < beds.size(); ++i) values.push_back(beds[i].*value - base[i].*value);
  return mean_of(values);
}

void add_row(Table& table, const Change& change, const std::vector<PouredBed>& beds,
             const std::vector<PouredBed>& base) {
  std::vector<std::string> row{change.knob,
                               change.value > 0 ? fmt::format("{:g}", change.value) : change.label,
                               fmt::format("{}", beds.size())};
  for (const Column& c : kColumns) {
    const Mean m = over_seeds(beds, c.value);
    row.push_back(fmt::format("{:.5g}", m.value));
    row.push_back(fmt::format("{:.2g}", m.error));
  }
  for (double PouredBed::*value : {&PouredBed::density, &PouredBed::mean_height_mm}) {
    const Mean m = paired(beds, base, value);
    row.push_back(fmt::format("{:+.5f}", m.value));
    row.push_back(fmt::format("{:.2g}", m.error));
  }
  int passed = 0;
  for (const PouredBed& b : beds) passed += b.audit;
  row.push_back(fmt::format("{}", passed));
  row.push_back(beds.front().hash);
  table.rows.push_back(row);
}

void add_point(Picture& picture, const Change& change, const std::vector<PouredBed>& beds,
               double PouredBed::*value) {
  if (picture.series.empty() || picture.series.back().name != change.knob)
    picture.series.push_back({change.knob, {}, {}, {}, {}});
  Series& series = picture.series.back();
  const Mean m = over_seeds(beds, value);
  series.x.push_back(over_seeds(beds, &PouredBed::cpu_s).value);
  series.y.push_back(m.value);
  series.error.push_back(m.error);
  series.label.push_back(change.value > 0 ? fmt::format("{:g}", change.value) : change.label);
}

}  // namespace

Outcome bench_bed(const Options& options) {
  Outcome out;
  out.table.columns = {"knob", "value", "seeds"};
  for (const Column& c : kColumns) {
    out.table.columns.push_back(c.name);
    out.table.columns.push_back("standard error");
  }
  for (const char* name : {"density, less the case's", "standard error", "mean height, less the case's [mm]",
                           "standard error", "audits passed", "bed of the first seed"})
    out.table.columns.emplace_back(name);
  Picture density{"bed_density",
                  "Packing density of beds",
                  {"CPU time of a bed [s]", false},
                  {"packing density", false},
                  {}};
  Picture height{"bed_height",
                 "Mean height of pellets",
                 {"CPU time of a bed [s]", false},
                 {"mean height [mm]", false},
                 {}};
  const int seeds = options.seeds > 0 ? options.seeds : options.quick ? 2 : 10;
  std::vector<PouredBed> base;
  for (const Change& change : changes(options.quick)) {
    options.tell(fmt::format("bed: {} {:g}", change.knob, change.value));
    std::vector<PouredBed> beds;
    for (int seed = 1; seed <= seeds; ++seed) {
      Scene scene = poured_scene(options, static_cast<std::uint64_t>(seed));
      change.apply(scene);
      beds.push_back(pour(scene));
    }
    if (base.empty()) base = beds;
    add_row(out.table, change, beds, base);
    add_point(density, change, beds, &PouredBed::density);
    add_point(height, change, beds, &PouredBed::mean_height_mm);
    if (&beds != &base && change.knob != "as it stands") {
      const Mean d = paired(beds, base, &PouredBed::density),
                 h = paired(beds, base, &PouredBed::mean_height_mm);
      out.findings.push_back(
          fmt::format("{} {}: density {:+.4f} +- {:.4f}, mean height {:+.3f} +- {:.3f} mm against the case, "
                      "{:.2g} times its CPU",
                      change.knob, change.value > 0 ? fmt::format("{:g}", change.value) : change.label,
                      d.value, d.error, h.value, h.error,
                      over_seeds(beds, &PouredBed::cpu_s).value / over_seeds(base, &PouredBed::cpu_s).value));
    }
  }
  out.pictures = {density, height};
  return out;
}

}  // namespace packbed::bench
