// The run of the sphere packer: steps until the bed is at rest, and reports on the way.
#include <algorithm>

#include "math/threads.hpp"
#include "packers/run_watch.hpp"
#include "packers/spheres/account.hpp"
#include "packers/spheres/checkpoint.hpp"
#include "packers/spheres/step.hpp"

namespace packbed {
namespace {

using namespace spheres;

struct Run {
  const Model& model;
  State& state;
  Feeder& feeder;
  PhaseTimes times{};

  bool ended() const {
    const Stepping& s = model.stepping;
    if (s.duration > 0) return state.time >= s.duration - 0.5 * model.step;
    return state.time >= s.max_time || (feeder.done() && state.rest.at_rest);
  }
  std::int64_t steps() const { return state.steps; }
  double time() const { return state.time; }
  double step_time() const { return model.step; }
  std::vector<std::byte> save() const { return spheres::save(state, feeder); }
  Snapshot snapshot(std::vector<Pellet>& pellets) const { return snapshot_of(model, state, pellets); }
  Progress progress() const {
    return progress_of(state, model.expected_time, model.stepping, feeder, state.rest.last_watch > 0);
  }
};

}  // namespace

PackResult pack_spheres(const Scene& scene, const Watch& watch, std::span<const std::byte> bytes) {
  RunWatch watcher(watch, scene.output);
  const Model model = make_model(scene);
  Feeder feeder(scene);
  State state;
  if (!bytes.empty()) restore(bytes, state, feeder);
  // who is there from the start enters before there is a result folder: a cloud may find no room
  if (bytes.empty()) feed(model, state, feeder);
  PackResult result;
  RunRecord& record = result.record;
  watcher.begin(record);
  Run run{model, state, feeder};
  while (!run.ended() && !result.stopped) {
    step(model, state, feeder, run.times);
    watcher.look(run);
    result.stopped = watcher.stop_asked();
  }
  if (result.stopped) watcher.save_now(run);

  settle_accounts(state);
  result.bed = bed_of(scene, model, state);
  fill_record(record, scene, model, state, feeder);
  record.bed_hash = bed_hash(result.bed);
  record.threads = threads();
  for (std::size_t k = 0; k < kPhases; ++k) record.time.phases_s[std::string(kPhaseName[k])] = run.times[k];
  watcher.fill_times(record, state);
  return result;
}

}  // namespace packbed
