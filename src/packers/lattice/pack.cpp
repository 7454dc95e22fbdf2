// The run of the lattice packers: steps until the bed has stopped sinking, and reports on the way.
#include <algorithm>

#include "math/clock.hpp"
#include "math/threads.hpp"
#include "packers/lattice/account.hpp"
#include "packers/lattice/checkpoint.hpp"
#include "packers/lattice/step.hpp"
#include "packers/packer.hpp"

namespace packbed {
namespace {

using namespace lattice;

constexpr double kProgressSeconds = 0.25;
constexpr int kLookEvery = 16;  // steps; the clock is not asked every step

using PhaseTimes = std::array<double, kPhases>;

void step(const Model& model, State& state, Feeder& feeder, PhaseTimes& times) {
  double last = wall_seconds();
  const auto done = [&](Phase phase) {
    const double now = wall_seconds();
    times[phase] += now - last;
    last = now;
  };
  feed(model, state, feeder), done(kFeed);
  move(model, state), done(kMove);
  rest(model, state, feeder), done(kRest);
}

/// Calls the watcher when it is time, and never changes what is packed.
class Watcher {
 public:
  Watcher(const Watch& watch, const Scene& scene) : watch_(watch), output_(scene.output) {}

  void look(const Model& model, State& state, const Feeder& feeder) {
    show(model, state);
    if (state.steps % kLookEvery != 0) return;
    const double now = wall_seconds();
    if (watch_.progress && now - shown_ >= kProgressSeconds) {
      shown_ = now;
      watch_.progress(progress(model, state, feeder));
    }
    if (watch_.checkpoint && output_.checkpoint_interval > 0 && now - saved_ >= output_.checkpoint_interval)
      save_now(state, feeder);
  }

  void save_now(State& state, const Feeder& feeder) {
    saved_ = wall_seconds();
    if (!watch_.checkpoint) return;
    const double wall = state.wall_s, cpu = state.cpu_s;
    state.wall_s += saved_ - wall_start_;
    state.cpu_s += cpu_seconds() - cpu_start_;
    watch_.checkpoint(save(state, feeder));
    state.wall_s = wall;
    state.cpu_s = cpu;
  }

 private:
  void show(const Model& model, State& state) {
    const double interval = output_.trajectory_interval, time = time_of(model, state);
    if (!watch_.snapshot || !(interval > 0)) return;
    if (time + 0.5 * model.step_time < interval * static_cast<double>(state.snapshots)) return;
    const std::vector<Pellet> pellets = pellets_of(model, state);
    Snapshot shot;
    shot.time = time;
    shot.pellets = &pellets;
    shot.energies.resize(pellets.size());
    watch_.snapshot(shot);
    ++state.snapshots;
  }

  static Progress progress(const Model& model, const State& state, const Feeder& feeder) {
    Progress p;
    p.simulated_s = time_of(model, state);
    p.steps = state.steps;
    p.fed = feeder.fed();
    p.asked = feeder.asked();
    p.phase = feeder.done() ? "settling" : feeder.waiting() ? "waiting for room" : "feeding";
    // settling takes some two windows and the last fall; pellets present set the price of a step
    const double x = static_cast<double>(p.fed) / std::max(1, p.asked);
    p.fraction = 0.7 * x * x;
    return p;
  }

  const Watch& watch_;
  const OutputWish& output_;
  double shown_ = 0, saved_ = wall_seconds();
  double wall_start_ = wall_seconds(), cpu_start_ = cpu_seconds();
};

}  // namespace

bool packs_on_lattice(const std::string& method) {
  return method == "digipac" || method == "digicgp";
}

PackResult pack_lattice(const Scene& scene, const Watch& watch, std::span<const std::byte> bytes) {
  const double wall_start = wall_seconds(), cpu_start = cpu_seconds();
  const Model model = make_model(scene);
  Feeder feeder(scene);
  State state(model);
  if (!bytes.empty()) restore(bytes, model, state, feeder);
  PhaseTimes times{};
  Watcher watcher(watch, scene);
  PackResult result;
  result.record.time.setup_s = wall_seconds() - wall_start;
  while (!state.at_rest && state.steps < model.rules.max_steps && !result.stopped) {
    step(model, state, feeder, times);
    watcher.look(model, state, feeder);
    result.stopped = watch.stop && *watch.stop;
  }
  if (result.stopped) watcher.save_now(state, feeder);

  result.bed = bed_of(model, state);
  result.grid = grid_of(result.bed, model, state);
  RunRecord& record = result.record;
  fill_record(record, model, state, feeder);
  record.bed_hash = bed_hash(result.bed);
  record.threads = threads();
  record.time.wall_s = state.wall_s + wall_seconds() - wall_start;
  record.time.cpu_s = state.cpu_s + cpu_seconds() - cpu_start;
  for (std::size_t k = 0; k < kPhases; ++k) record.time.phases_s[std::string(kPhaseName[k])] = times[k];
  record.peak_rss_bytes = peak_rss_bytes();
  return result;
}

}  // namespace packbed
