// What a scene does not need: the same bed with each optional part needed and not needed.
#include <fmt/format.h>

#include <functional>

#include "analysis/analyse.hpp"
#include "bench/bench.hpp"
#include "bench/pour.hpp"
#include "math/clock.hpp"
#include "packers/packer.hpp"

namespace packbed::bench {
namespace {

struct Part {
  std::string name;
  std::function<void(Scene&)> change;
};

const std::vector<Part> kParts = {
    {"as the case says", [](Scene&) {}},
    {"friction not needed", [](Scene& s) { s.pellet_contact.friction = s.wall_contact.friction = 0; }},
    {"torsion not needed", [](Scene& s) { s.pellet_contact.torsion = s.wall_contact.torsion = false; }},
    {"rolling friction not needed",
     [](Scene& s) { s.pellet_contact.rolling_friction = s.wall_contact.rolling_friction = 0; }},
    {"sleep not needed", [](Scene& s) { s.stepping.sleep = false; }},
    {"field needed", [](Scene& s) { s.kernel = "field"; }},
    {"snapshots needed, every 5 ms", [](Scene& s) { s.output.trajectory_interval = 5e-3; }},
    {"orientation and exact profiles not needed",
     [](Scene& s) { s.analysis.orientation = s.analysis.exact = false; }},
    {"voxels not needed", [](Scene& s) { s.analysis.voxels = false; }},
    {"overlap audit not needed", [](Scene& s) { s.analysis.overlap = false; }},
};

struct Cost {
  PackResult result;
  double analyse_s = 0, setup_s = 0, step_us = 0;
};

Cost run(const Scene& scene) {
  Cost cost;
  Watch watch;
  watch.snapshot = [](const Snapshot&) {};
  cost.result = pack(scene, watch);
  const double begin = cpu_seconds();
  analyse_bed(cost.result.bed, scene.analysis);
  cost.analyse_s = cpu_seconds() - begin;
  const auto& time = cost.result.record.time;
  cost.setup_s = time.setup_s;
  cost.step_us = 1e6 * (time.cpu_s - time.setup_s) / static_cast<double>(time.steps);
  return cost;
}

}  // namespace

Outcome bench_skipping(const Options& options) {
  Outcome out;
  out.table.columns = {
      "part", "set-up [ms]", "a step [us]", "analysis [CPU s]", "steps", "largest memory so far [MB]", "bed"};
  Series step{"a step [us]", {}, {}, {}, {}, false}, analysis{"analysis [CPU ms]", {}, {}, {}, {}, false};
  double x = 0;
  for (const Part& part : kParts) {
    options.tell("skipping: " + part.name);
    Scene scene = poured_scene(options, 1);
    // the same steps in each: what is measured is a step, not how soon rest is found
    scene.stepping.duration = options.quick ? 0.2 : 0.6;
    part.change(scene);
    const Cost cost = run(scene);
    out.table.add(part.name, 1e3 * cost.setup_s, cost.step_us, cost.analyse_s, cost.result.record.time.steps,
                  static_cast<double>(cost.result.record.peak_rss_bytes) / 1e6, cost.result.record.bed_hash);
    x += 1;
    for (Series* s : {&step, &analysis}) {
      s->x.push_back(x);
      s->label.push_back(s == &step ? part.name : "");
    }
    step.y.push_back(cost.step_us);
    analysis.y.push_back(1e3 * cost.analyse_s);
  }
  out.pictures.push_back({"skipping",
                          "The same bed with parts needed and not needed",
                          {"row of the table", false},
                          {"time", true},
                          {step, analysis}});
  return out;
}

}  // namespace packbed::bench
