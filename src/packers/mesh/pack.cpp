// The run of the mesh packer: steps until the bed is at rest, and reports on the way.

#include "math/threads.hpp"
#include "packers/mesh/account.hpp"
#include "packers/mesh/checkpoint.hpp"
#include "packers/mesh/flight.hpp"
#include "packers/mesh/step.hpp"
#include "packers/run_watch.hpp"

namespace packbed {
namespace {

using namespace mesh;

bool finished(const Model& model, const State& state, const Feeder& feeder) {
  if (pierced(model, state)) return true;
  if (model.stepping.duration > 0) return state.time >= model.stepping.duration - 0.5 * model.step;
  if (state.time >= model.stepping.max_time) return true;
  return feeder.done() && state.rest.at_rest;
}

struct Run {
  const Model& model;
  State& state;
  Feeder& feeder;

  std::int64_t steps() const { return state.steps; }
  double time() const { return state.time; }
  double step_time() const { return model.step; }
  std::vector<std::byte> save() const { return mesh::save(state, feeder); }
  Snapshot snapshot(std::vector<Pellet>& pellets) const {
    State copy = state;  // airborne bodies are shown where they are now, but keep their leap
    catch_up(model, copy);
    return snapshot_of(model, copy, pellets);
  }
  Progress progress() const {
    return progress_of(state, model.expected_time, model.stepping, feeder, state.rest.last_watch > 0);
  }
};

}  // namespace

PackResult pack_mesh(const Scene& scene, const Watch& watch, std::span<const std::byte> bytes) {
  RunWatch watcher(watch, scene.output);
  const Model model = make_model(scene);
  Feeder feeder(scene);
  State state;
  if (!bytes.empty()) restore(bytes, state, feeder);
  PhaseTimes times{};
  PackResult result;
  // who is there from the start enters before there is a result folder: a cloud may find no room
  if (bytes.empty() && enters_at_once(scene.feed.kind)) begin(model, state, feeder);
  watcher.begin(result.record);
  Run run{model, state, feeder};
  while (!finished(model, state, feeder) && !result.stopped) {
    step(model, state, feeder, times);
    if (feeder.done() && state.rest.at_rest) shake(scene, state);
    watcher.look(run);
    result.stopped = watcher.stop_asked();
  }
  if (result.stopped) watcher.save_now(run);

  catch_up(model, state);
  settle_accounts(state);
  result.bed = bed_of(scene, model, state);
  RunRecord& record = result.record;
  fill_record(record, scene, model, state, feeder);
  record.bed_hash = bed_hash(result.bed);
  record.threads = threads();
  for (std::size_t k = 0; k < kPhases; ++k) record.time.phases_s[std::string(kPhaseName[k])] = times[k];
  watcher.fill_times(record, state);
  return result;
}

}  // namespace packbed
