// The run of digipac and digicgp: steps until the bed has stopped sinking, and reports on the way.
#include <algorithm>

#include "math/threads.hpp"
#include "packers/lattice/account.hpp"
#include "packers/lattice/checkpoint.hpp"
#include "packers/lattice/dem_run.hpp"
#include "packers/lattice/step.hpp"
#include "packers/run_watch.hpp"

namespace packbed {
namespace {

using namespace lattice;

struct Run {
  const Model& model;
  State& state;
  Feeder& feeder;
  std::array<double, kPhases> phases{};

  void step() {
    double last = wall_seconds();
    feed(model, state, feeder), add_phase(phases[kFeed], last);
    move(model, state), add_phase(phases[kMove], last);
    rest(model, state, feeder), add_phase(phases[kRest], last);
  }
  bool ended() const { return state.at_rest || state.steps >= model.rules.max_steps; }

  std::int64_t steps() const { return state.steps; }
  double time() const { return time_of(model, state); }
  double step_time() const { return model.step_time; }
  Snapshot snapshot(std::vector<Pellet>& pellets) const {
    pellets = pellets_of(model, state);
    return still_of(time(), pellets);
  }
  std::vector<std::byte> save() const { return lattice::save(model, state, feeder); }
  Progress progress() const {
    Progress p;
    p.simulated_s = time();
    p.steps = state.steps;
    p.fed = feeder.fed();
    p.asked = feeder.asked();
    p.phase = feeder.done() ? "settling" : feeder.waiting() ? "waiting for room" : "feeding";
    // settling takes some windows and the last fall; the pellets present set the price of a step
    const double x = static_cast<double>(p.fed) / std::max(1, p.asked);
    p.fraction = 0.7 * x * x;
    return p;
  }
};

}  // namespace

bool packs_on_lattice(const std::string& method) {
  return method == "digipac" || method == "digicgp" || method == "digidem";
}

PackResult pack_lattice(const Scene& scene, const Watch& watch, std::span<const std::byte> bytes) {
  if (scene.method == "digidem") return pack_digidem(scene, watch, bytes);
  RunWatch watcher(watch, scene.output);
  const Model model = make_model(scene);
  Feeder feeder(scene);
  State state(model);
  if (!bytes.empty()) restore(bytes, model, state, feeder);
  PackResult result;
  RunRecord& record = result.record;
  watcher.begin(record);
  Run run{model, state, feeder};
  while (!run.ended() && !result.stopped) {
    run.step();
    watcher.look(run);
    result.stopped = watcher.stop_asked();
  }
  if (result.stopped) watcher.save_now(run);

  result.bed = bed_of(model, state);
  result.grid = grid_of(result.bed, model, state);
  fill_record(record, model, state, feeder);
  record.bed_hash = bed_hash(result.bed);
  record.threads = threads();
  for (std::size_t k = 0; k < kPhases; ++k) record.time.phases_s[std::string(kPhaseName[k])] = run.phases[k];
  watcher.fill_times(record, state);
  return result;
}

}  // namespace packbed
