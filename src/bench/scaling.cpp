// Cost against the number of pellets, at equal height of the bed, and against threads.
#include <fmt/format.h>

#include <cmath>

#include "bench/bench.hpp"
#include "bench/pour.hpp"
#include "math/threads.hpp"
#include "packers/packer.hpp"

namespace packbed::bench {
namespace {

/// The case with `pellets` in a tube as much wider, or narrower, as keeps the bed as high as `same` would be.
Scene widened(const Options& options, int pellets, int same) {
  Scene scene = poured_scene(options, 1);
  const double wider = static_cast<double>(pellets) / same;
  scene.feed.per_layer = std::max(1, static_cast<int>(std::lround(scene.feed.per_layer * wider)));
  scene.feed.count = pellets;
  scene.container = make_tube("tube", 2 * std::sqrt(wider) * scene.container.radius, scene.container.height);
  scene.feed.radius *= std::sqrt(wider);
  return scene;
}

}  // namespace

Outcome bench_scaling(const Options& options) {
  Outcome out;
  out.table.columns = {"pellets",
                       "threads",
                       "inner diameter of the tube [mm]",
                       "steps",
                       "CPU [s]",
                       "wall [s]",
                       "CPU a pellet [ms]",
                       "CPU a pellet and step [us]",
                       "largest memory so far [MB]",
                       "bed"};
  Picture picture{
      "scaling", "Cost at equal height of the bed", {"pellets", true}, {"CPU time a pellet [ms]", true}, {}};
  const int all_threads = threads(), most = options.pellets > 0 ? options.pellets : 30000;
  const std::vector<int> sizes =
      options.quick ? std::vector{75, 150} : std::vector{300, 1000, 3000, 10000, 30000};
  const int same = options.quick ? 150 : 1500;  // pellets in the tube of the case
  for (const int count : options.quick ? std::vector{1, 2} : std::vector{1, 2, 4}) {
    set_threads(count);
    Series series{fmt::format("{} thread{}", count, count > 1 ? "s" : ""), {}, {}, {}, {}};
    for (const int pellets : sizes) {
      if (pellets > most) continue;
      options.tell(fmt::format("scaling: {} pellets, {} threads", pellets, count));
      const Scene scene = widened(options, pellets, same);
      const RunRecord record = pack(scene, {}).record;
      const double each = record.time.cpu_s / pellets;
      out.table.add(pellets, count, 2e3 * scene.container.radius, record.time.steps, record.time.cpu_s,
                    record.time.wall_s, 1e3 * each, 1e6 * each / static_cast<double>(record.time.steps),
                    static_cast<double>(record.peak_rss_bytes) / 1e6, record.bed_hash);
      series.x.push_back(pellets);
      series.y.push_back(1e3 * each);
    }
    if (series.y.size() > 1)
      out.findings.push_back(
          fmt::format("{}: from {:g} to {:g} pellets the CPU time a pellet grows by {:.2f}", series.name,
                      series.x.front(), series.x.back(), series.y.back() / series.y.front()));
    picture.series.push_back(series);
  }
  set_threads(all_threads);
  out.pictures.push_back(picture);
  return out;
}

}  // namespace packbed::bench
