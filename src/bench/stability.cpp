#include "bench/stability.hpp"

#include <fmt/format.h>

#include "bench/bench.hpp"

namespace packbed::bench {
namespace {

void add(Outcome& out, const Options& options, const Verdict& v) {
  options.tell(fmt::format("stability: {}: {} ({})", v.test, v.passed ? "pass" : "FAIL", v.found));
  out.table.add(v.test, v.asked, v.found, v.passed ? "pass" : "FAIL");
  if (!v.passed)
    out.findings.push_back(fmt::format("FAIL: {}: asked: {}; found: {}", v.test, v.asked, v.found));
  out.passed = out.passed && v.passed;
}

}  // namespace

Outcome bench_stability(const Options& options) {
  Outcome out;
  out.table.columns = {"test", "asked", "found", "verdict"};
  const bool quick = options.quick;
  add(out, options, top_keeps_turning(quick ? 1000000 : 10000000));
  add(out, options, cloud_keeps_momentum(quick ? 10000 : 1000000));
  add(out, options, forces_stay_finite("cylinder", quick ? 20000 : 1000000));
  add(out, options, forces_stay_finite("field", quick ? 5000 : 200000));
  for (const char* pellet : {"sphere", "A38", "cube", "ring"})
    add(out, options, impacts_keep_energy(pellet, quick ? 50 : 1000));
  for (const double tilt : {20.0, 35.0, 60.0, 75.0}) add(out, options, oblique_rim_impact(tilt, 0.1));
  for (const auto& [pellets, floor] :
       {std::pair(0.29, 0.5), std::pair(0.25, 0.5), std::pair(0.5, 0.1), std::pair(0.5, 0.08)})
    add(out, options, pyramid_stands_or_falls(pellets, floor));
  add(out, options, deep_start_is_gentle());
  add(out, options, rings_bounce_off(quick ? 50 : 10000));
  if (!quick)
    for (const Verdict& v : wild_settings(options.case_file)) add(out, options, v);
  int passed = 0;
  for (const auto& row : out.table.rows) passed += row.back() == "pass";
  out.findings.insert(out.findings.begin(),
                      fmt::format("{} of {} tests passed", passed, out.table.rows.size()));
  return out;
}

}  // namespace packbed::bench
