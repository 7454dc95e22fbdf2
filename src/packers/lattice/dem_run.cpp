#include "packers/lattice/dem_run.hpp"
#include "packers/checkpoint.hpp"
#include "packers/lattice/account.hpp"
#include "packers/lattice/dem.hpp"
#include "packers/run_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/threads.hpp"

namespace packbed::lattice {
namespace {

constexpr std::uint64_t kFormat = 0x706b6264'44000007;  // changes with any change of DemState

/// Names every member once, for writing and for reading.
template <class Archive, class S>
void visit(Archive& io, S& s) {
  auto& b = s.bodies;
  io(b.kind), io(b.inverse_mass), io(b.mass), io(b.inertia), io(b.inverse_inertia), io(b.bounding_radius),
      io(b.scale);
  io(b.position), io(b.rotation), io(b.axis), io(b.velocity), io(b.angular_momentum), io(b.spin),
      io(b.travel);
  io(b.force), io(b.torque), io(b.motion);
  io(s.drawn), io(s.cell), io(s.offset), io(s.turn), io(s.phase), io(s.version), io(s.touches), io(s.doze),
      io(s.listed_at), io(s.search_due), io(s.waited);
  io(s.time), io(s.steps), io(s.snapshots), io(s.searches), io(s.sleeps), io(s.wakes);
  visit_shake(io, s.shake);
  visit_rest(io, s.rest);
  io(s.peak), io(s.wall_s), io(s.cpu_s);
}

void restore(std::span<const std::byte> bytes, const DemModel& model, DemState& state, Feeder& feeder) {
  restore_checkpoint(bytes, "digidem packing", kFormat, feeder, [&](ArchiveReader& io) { visit(io, state); });
  state.bodies.velocity_ahead.resize(state.size());
  state.bodies.spin_ahead.resize(state.size());
  StampMaker maker(model.base.frame.pitch, model.base.largest);
  for (std::size_t i = 0; i < state.size(); ++i)
    state.stamp.push_back(maker.make(*model.base.kind(state.bodies.kind[i]).shape, state.bodies.scale[i],
                                     state.drawn[i], state.phase[i]));
}

enum Phase : std::size_t { kFeed, kFindPairs, kTouch, kSleep, kMove, kRest, kShake, kPhases };
constexpr std::array<const char*, kPhases> kPhaseName{"feed", "find_pairs", "touch", "sleep",
                                                      "move", "rest",       "shake"};

struct Run {
  const DemModel& model;
  DemState& state;
  Feeder& feeder;
  std::array<double, kPhases> phases{};

  void step() {
    double last = wall_seconds();
    dem_feed(model, state, feeder), add_phase(phases[kFeed], last);
    dem_find_pairs(model, state), add_phase(phases[kFindPairs], last);
    dem_touch(model, state), add_phase(phases[kTouch], last);
    dem_sleep(model, state), add_phase(phases[kSleep], last);
    dem_move(model, state), add_phase(phases[kMove], last);
    dem_rest(model, state, feeder), add_phase(phases[kRest], last);
    dem_shake(model, state), add_phase(phases[kShake], last);
  }
  bool ended() const {
    const Stepping& s = model.base.scene->stepping;
    if (s.duration > 0) return state.time >= s.duration - 0.5 * model.step;
    return state.rest.at_rest || state.time >= s.max_time;
  }

  std::int64_t steps() const { return state.steps; }
  double time() const { return state.time; }
  double step_time() const { return model.step; }
  Snapshot snapshot(std::vector<Pellet>& pellets) const {
    pellets = pellets_of(state);
    return still_of(time(), pellets);
  }
  std::vector<std::byte> save() const {
    return checkpoint_of(kFormat, feeder, [&](ArchiveWriter& io) { visit(io, state); });
  }
  Progress progress() const {
    return progress_of(state, model.expected_time, model.base.scene->stepping, feeder,
                       state.rest.last_watch > 0);
  }
};

bool inside(const DemModel& model, const DemState& state, std::size_t i) {
  const Cell& c = state.cell[i];
  return c[2] >= 0 && c[2] < model.base.frame.size[2] && !state.walls.taken(c);
}

void audit(RunRecord& record, const DemModel& model, const DemState& state, const Feeder& feeder) {
  const auto line = [&](const char* name, bool passed, const std::string& finding) {
    record.audit.push_back({name, passed, finding});
  };
  auto& p = record.pellets;
  p.asked = feeder.asked();
  p.fed = feeder.fed();
  for (std::size_t i = 0; i < state.size(); ++i) p.inside += inside(model, state, i);
  p.escaped = p.fed - p.inside;
  line("pellets", feeder.done() && p.escaped == 0,
       fmt::format("{} asked, {} fed, {} inside, {} escaped", p.asked, p.fed, p.inside, p.escaped));
  const Stepping& s = model.base.scene->stepping;
  record.at_rest = state.rest.at_rest != 0;
  if (!(s.duration > 0))
    line("rest", record.at_rest,
         fmt::format("speed {:.2g} m/s, drift {:.2g} of the size in {:.2g} s (limit {:.2g})",
                     state.rest.speed, state.rest.drift, s.rest_window, s.rest_drift));
  double mean = 0, most = 0;
  int touching = 0;
  for (const Touch& t : state.touches) {
    if (!(t.depth > 0)) continue;
    ++touching;
    mean += t.depth;
    most = std::max(most, t.depth);
  }
  const double pitch = model.base.frame.pitch;
  constexpr double kMost = 2;  // cells; a small overlap belongs to the method
  line("cells", most <= kMost * pitch,
       fmt::format(
           "overlap {:.2f} voxels in the mean of {} touches, at most {:.2f} (limit {:g}); {:.2f} during "
           "the run",
           mean / pitch / std::max(1, touching), touching, most / pitch, kMost, state.peak / pitch));
}

PackedBed bed_of(const DemModel& model, const DemState& state) {
  PackedBed bed = bed_of_scene(*model.base.scene, "cells");
  bed.pellets = pellets_of(state);
  for (const Touch& t : state.touches)
    if (t.depth > 0)
      bed.contacts.push_back({t.a, is_wall(t.b) ? kContainer : t.b, t.point, t.force, t.depth});
  return bed;
}

}  // namespace

PackResult pack_digidem(const Scene& scene, const Watch& watch, std::span<const std::byte> bytes) {
  RunWatch watcher(watch, scene.output);
  const DemModel model = make_dem_model(scene);
  Feeder feeder(scene);
  DemState state(model);
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
  record.method = scene.method;
  record.kernel = "cells";
  record.seed = scene.seed;
  record.time.steps = state.steps;
  record.time.step_s = model.step;
  record.time.simulated_s = state.time;
  audit(record, model, state, feeder);
  record.counters = {{"stiffness_pellet_N_per_m", model.pellet.stiffness},
                     {"stiffness_wall_N_per_m", model.wall.stiffness},
                     {"searches", static_cast<double>(state.searches)},
                     {"sleeps", static_cast<double>(state.sleeps)},
                     {"wakes", static_cast<double>(state.wakes)},
                     {"touches", static_cast<double>(state.touches.size())},
                     {"voxel_m", model.base.frame.pitch}};
  record.taps = state.shake.found;
  record.notes = model.base.notes;
  if (state.waited) record.notes.push_back("feeding had to wait for room above the bed");
  record.bed_hash = bed_hash(result.bed);
  record.threads = threads();
  for (std::size_t k = 0; k < kPhases; ++k) record.time.phases_s[kPhaseName[k]] = run.phases[k];
  watcher.fill_times(record, state);
  return result;
}

}  // namespace packbed::lattice
