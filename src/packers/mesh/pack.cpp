// The run of the mesh packer: steps until the bed is at rest, and reports on the way.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include "math/threads.hpp"
#include "packers/mesh/account.hpp"
#include "packers/mesh/checkpoint.hpp"
#include "packers/mesh/flight.hpp"
#include "packers/mesh/step.hpp"
#include "packers/packer.hpp"

namespace packbed {
namespace {

using namespace mesh;

constexpr double kCheckpointSeconds = 30;  // between two checkpoints, wall-clock
constexpr double kProgressSeconds = 0.25;

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::int64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

/// "settling", and what is still too large for rest.
std::string settling(const Model& model, const State& state) {
  const Stepping& limit = model.stepping;
  std::string text = state.last_watch ? "watching" : "settling";
  const auto name = [&](const char* what, double value, double most) {
    if (value > most) text += fmt::format(", {} {:.2g} (limit {:.2g})", what, value, most);
  };
  name("speed m/s", state.rest_speed, limit.rest_speed);
  name("force", state.rest_force, limit.rest_force);
  name("drift", state.rest_drift, limit.rest_drift);
  return text;
}

bool finished(const Model& model, const State& state, const Feeder& feeder) {
  if (model.stepping.duration > 0) return state.time >= model.stepping.duration - 0.5 * model.step;
  if (state.time >= model.stepping.max_time) return true;
  return feeder.done() && state.at_rest;
}

/// Calls the watcher when it is time, and never changes the state.
class Watcher {
 public:
  Watcher(const Watch& watch, const Scene& scene)
      : watch_(watch), interval_(scene.output.trajectory_interval) {
    if (scene.output.checkpoint_interval > 0) checkpoint_every_ = scene.output.checkpoint_interval;
  }

  void look(const Model& model, State& state, const Feeder& feeder) {
    if (watch_.snapshot && interval_ > 0 &&
        state.time + 0.5 * model.step >= interval_ * static_cast<double>(state.snapshots)) {
      State copy = state;  // airborne bodies are shown where they are now, but keep their leap
      catch_up(model, copy);
      watch_.snapshot(snapshot_of(model, copy, pellets_));
      ++state.snapshots;
    }
    if (state.steps % 64 != 0) return;  // the clock is not asked every step
    const double now = wall_seconds();
    if (watch_.progress && now - shown_ >= kProgressSeconds) {
      shown_ = now;
      watch_.progress(progress(model, state, feeder));
    }
    if (watch_.checkpoint && now - saved_ >= checkpoint_every_) save_now(state, feeder);
  }

  void save_now(State& state, const Feeder& feeder) {
    saved_ = wall_seconds();
    if (!watch_.checkpoint) return;
    State copy = state;
    copy.wall_s += saved_ - wall_start_;
    copy.cpu_s += cpu_seconds() - cpu_start_;
    watch_.checkpoint(save(copy, feeder));
  }

 private:
  static Progress progress(const Model& model, const State& state, const Feeder& feeder) {
    Progress p;
    p.simulated_s = state.time;
    p.fed = feeder.fed();
    p.asked = feeder.asked();
    p.phase = feeder.done() ? settling(model, state) : feeder.waiting() ? "waiting for room" : "feeding";
    // the bed grows as it is fed, and so does the price of a step: work goes like the square of the time
    const double x = model.expected_time > 0 ? std::min(1.0, state.time / model.expected_time) : 0.0;
    p.fraction = x * x;
    return p;
  }

  const Watch& watch_;
  double interval_, checkpoint_every_ = kCheckpointSeconds;
  double shown_ = 0, saved_ = wall_seconds();
  double wall_start_ = wall_seconds(), cpu_start_ = cpu_seconds();
  std::vector<Pellet> pellets_;
};

}  // namespace

PackResult pack_mesh(const Scene& scene, const Watch& watch, std::span<const std::byte> bytes) {
  const double wall_start = wall_seconds(), cpu_start = cpu_seconds();
  const Model model = make_model(scene);
  Feeder feeder(scene);
  State state;
  if (!bytes.empty()) restore(bytes, state, feeder);
  PhaseTimes times{};
  Watcher watcher(watch, scene);
  PackResult result;
  result.record.time.setup_s = wall_seconds() - wall_start;

  while (!finished(model, state, feeder)) {
    step(model, state, feeder, times);
    watcher.look(model, state, feeder);
    if (watch.stop && *watch.stop) {
      result.stopped = true;
      break;
    }
  }
  if (result.stopped) watcher.save_now(state, feeder);

  catch_up(model, state);
  settle_accounts(state);
  result.bed = bed_of(scene, model, state);
  RunRecord& record = result.record;
  fill_record(record, scene, model, state, feeder);
  record.bed_hash = bed_hash(result.bed);
  record.threads = threads();
  record.time.wall_s = state.wall_s + wall_seconds() - wall_start;
  record.time.cpu_s = state.cpu_s + cpu_seconds() - cpu_start;
  for (std::size_t k = 0; k < kPhases; ++k) record.time.phases_s[std::string(kPhaseName[k])] = times[k];
  record.peak_rss_bytes = peak_rss_bytes();
  return result;
}

}  // namespace packbed
