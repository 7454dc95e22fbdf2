#pragma once
// How a run is watched, whatever packs: progress, checkpoints and snapshots when they are due.
#include <algorithm>

#include "math/clock.hpp"
#include "packers/feed.hpp"
#include "packers/packer.hpp"
#include "packers/rest_watch.hpp"

namespace packbed {

class RunWatch {
 public:
  RunWatch(const Watch& watch, const OutputWish& output) : watch_(watch), output_(output) {}

  /// The scene has been set up, and with it refused if it has to be.
  void begin(RunRecord& record) const {
    record.time.setup_s = wall_seconds() - wall_start_;
    if (watch_.accepted) watch_.accepted();
  }

  /// Run offers steps(), time(), step_time(), progress(), snapshot(pellets), save(), and the counters
  /// snapshots, wall_s and cpu_s of its state; nothing that is packed changes.
  template <class Run>
  void look(Run& run) {
    show(run);
    constexpr int kLookEvery = 16;  // steps; the clock is not asked every step
    constexpr double kProgressSeconds = 0.25;
    if (run.steps() % kLookEvery != 0) return;
    const double now = wall_seconds();
    if (watch_.progress && now - shown_ >= kProgressSeconds) {
      shown_ = now;
      watch_.progress(run.progress());
    }
    const double every = output_.checkpoint_interval;
    if (watch_.checkpoint && every > 0 && now - saved_ >= every) save_now(run);
  }

  template <class Run>
  void save_now(Run& run) {
    saved_ = wall_seconds();
    if (!watch_.checkpoint) return;
    auto& state = run.state;
    const double wall = state.wall_s, cpu = state.cpu_s;
    state.wall_s += saved_ - wall_start_;
    state.cpu_s += cpu_seconds() - cpu_start_;
    watch_.checkpoint(run.save());
    state.wall_s = wall;
    state.cpu_s = cpu;
  }

  bool stop_asked() const { return watch_.stop && *watch_.stop; }

  /// Times and memory of the whole run, the parts before a resume included.
  template <class State>
  void fill_times(RunRecord& record, const State& state) const {
    record.time.wall_s = state.wall_s + wall_seconds() - wall_start_;
    record.time.cpu_s = state.cpu_s + cpu_seconds() - cpu_start_;
    record.peak_rss_bytes = peak_rss_bytes();
  }

 private:
  template <class Run>
  void show(Run& run) {
    const double interval = output_.trajectory_interval;
    if (!watch_.snapshot || !(interval > 0)) return;
    if (run.time() + 0.5 * run.step_time() < interval * static_cast<double>(run.state.snapshots)) return;
    watch_.snapshot(run.snapshot(pellets_));
    ++run.state.snapshots;
  }

  const Watch& watch_;
  const OutputWish& output_;
  double wall_start_ = wall_seconds(), cpu_start_ = cpu_seconds();
  double shown_ = 0, saved_ = wall_start_;
  std::vector<Pellet> pellets_;  // of the last snapshot
};

/// "settling", or "watching" when rest was found and is asked for again, and what is still too large for
/// rest.
std::string settling_text(const Stepping& limits, const RestWatch& rest, bool watching);

/// Of a run by simulated time.
template <class State>
Progress progress_of(const State& state, double expected_time, const Stepping& stepping, const Feeder& feeder,
                     bool watching = false) {
  Progress p;
  p.simulated_s = state.time;
  p.fed = feeder.fed();
  p.asked = feeder.asked();
  p.phase = feeder.done()      ? settling_text(stepping, state.rest, watching)
            : feeder.waiting() ? "waiting for room"
                               : "feeding";
  // the bed grows as it is fed, and so does the price of a step: work goes like the square of the time
  const double x = expected_time > 0 ? std::min(1.0, state.time / expected_time) : 0.0;
  p.fraction = x * x;
  return p;
}

/// Adds the wall-clock time since `last` to a phase.
inline void add_phase(double& phase, double& last) {
  const double now = wall_seconds();
  phase += now - last;
  last = now;
}

}  // namespace packbed
