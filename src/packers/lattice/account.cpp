#include "packers/lattice/account.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "bed/voxelise.hpp"
#include "lattice/digital_rotation.hpp"

namespace packbed::lattice {
namespace {

void audit_pellets(RunRecord& record, const State& state, const Feeder& feeder) {
  record.pellets.asked = feeder.asked();
  record.pellets.fed = feeder.fed();
  record.pellets.inside = static_cast<int>(state.size());  // the lattice ends at the container
  record.pellets.escaped = feeder.fed() - record.pellets.inside;
  add_line(record, "pellets", feeder.done() && record.pellets.escaped == 0,
           fmt::format("{} asked, {} fed, {} inside, {} without room", record.pellets.asked,
                       record.pellets.fed, record.pellets.inside, record.pellets.escaped));
}

/// The lattice is emptied, and every pellet is drawn anew from its shape and pose.
void audit_cells(RunRecord& record, const Model& model, State& state) {
  StampMaker maker(model.frame.pitch, model.largest);
  Occupancy& lattice = state.lattice;
  for (std::size_t i = 0; i < state.size(); ++i) lattice.flip(state.stamp[i], state.cell[i]);
  const std::int64_t left = lattice.open_cells() - lattice.count_open();
  const bool may_wear = model.rules.turn_cells;
  std::int64_t shared = 0, changed = 0;
  double mean = 0, worst = 0, worn = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Shape& shape = *model.kind(state.kind[i]).shape;
    const Stamp drawn = maker.make(shape, state.scale[i], state.rotation[i], state.phase[i]);
    const Stamp& stamp = may_wear ? state.stamp[i] : drawn;
    if (may_wear) worn += wear(stamp, drawn) / static_cast<double>(state.size());
    changed += stamp.bits != state.stamp[i].bits;
    shared += lattice.shared(stamp, state.cell[i]);
    lattice.write(stamp, state.cell[i]);
    const double exact = shape.volume * std::pow(state.scale[i] / model.frame.pitch, 3);
    const double off = static_cast<double>(stamp.count) / exact - 1;
    mean += off / static_cast<double>(state.size());
    worst = std::max(worst, std::abs(off));
  }
  shared += std::abs(left);  // what was on the lattice and belonged to no pellet
  add_line(
      record, "cells", shared == 0 && changed == 0,
      fmt::format("{} shared by two pellets or with the wall, {} pellets deformed (limits 0); volume of the "
                  "pellets in cells {:+.3f} % in the mean, at most {:.2f} % off",
                  shared, changed, 100 * mean, 100 * worst));
  if (may_wear)
    record.notes.push_back(
        fmt::format("lattice.rotation = \"cells\": {:.1f} % of a pellet's cells are not where its shape has "
                    "them, in the mean",
                    100 * worn));
}

void audit_rest(RunRecord& record, const Model& model, const State& state) {
  record.at_rest = state.at_rest != 0;
  add_line(record, "rest", record.at_rest,
           fmt::format("the bed sank by {:.3f} voxels in the last {} steps (limit {:g})", state.sinking,
                       model.rules.rest_window, model.rules.rest_sinking));
}

}  // namespace

PackedBed bed_of(const Model& model, const State& state) {
  PackedBed bed = bed_of_scene(*model.scene, "cells");
  bed.pellets = pellets_of(model, state);
  return bed;
}

VoxelGrid grid_of(const PackedBed& bed, const Model& model, const State& state) {
  VoxelGrid grid(frame_for(bed, model.frame.pitch));
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Cell& at = state.cell[i];
    for_each_cell(state.stamp[i], [&](int x, int y, int z) {
      const int gx = at[0] + x;
      grid.words[grid.row(at[1] + y, at[2] + z) + static_cast<std::size_t>(gx) / 64] |= std::uint64_t{1}
                                                                                        << (gx % 64);
    });
  }
  return grid;
}

void fill_record(RunRecord& record, const Model& model, State& state, const Feeder& feeder) {
  record.method = model.scene->method;
  record.kernel = "cells";
  record.seed = model.scene->seed;
  record.time.steps = state.steps;
  record.time.step_s = model.step_time;
  record.time.simulated_s = time_of(model, state);
  record.notes = model.notes;
  audit_pellets(record, state, feeder);
  audit_cells(record, model, state);
  audit_rest(record, model, state);
  const Tally& t = state.tally;
  record.counters = {
      {"moves_tried", t.moves},         {"moves_made", t.moved},
      {"rotations_tried", t.rotations}, {"rotations_made", t.rotated},
      {"voxel_m", model.frame.pitch},   {"lattice_bytes", static_cast<double>(state.lattice.bytes())}};
  record.notes.push_back(
      fmt::format("time is nominal: {} steps stand for feed.interval", model.rules.interval));
  if (state.waited) record.notes.push_back("feeding had to wait for room above the bed");
}

}  // namespace packbed::lattice
