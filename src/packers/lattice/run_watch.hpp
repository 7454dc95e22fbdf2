#pragma once
// How the run of a lattice packer is watched: progress, checkpoints and snapshots when they are due.
#include "math/clock.hpp"
#include "packers/packer.hpp"

namespace packbed::lattice {

class RunWatch {
 public:
  RunWatch(const Watch& watch, const OutputWish& output) : watch_(watch), output_(output) {}

  /// Run offers steps, time(), progress(), pellets(), save(), and the counters snapshots, wall_s and cpu_s of
  /// its state; nothing that is packed changes.
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
    if (run.time() < interval * static_cast<double>(run.state.snapshots) * (1 - 1e-9)) return;
    const std::vector<Pellet> pellets = run.pellets();
    Snapshot shot;
    shot.time = run.time();
    shot.pellets = &pellets;
    shot.energies.resize(pellets.size());
    watch_.snapshot(shot);
    ++run.state.snapshots;
  }

  const Watch& watch_;
  const OutputWish& output_;
  double wall_start_ = wall_seconds(), cpu_start_ = cpu_seconds();
  double shown_ = 0, saved_ = wall_start_;
};

/// Adds the wall-clock time since `last` to a phase.
inline void add_phase(double& phase, double& last) {
  const double now = wall_seconds();
  phase += now - last;
  last = now;
}

}  // namespace packbed::lattice
