#include "packers/lattice/checkpoint.hpp"

#include "packers/checkpoint.hpp"

namespace packbed::lattice {
namespace {

constexpr std::uint64_t kFormat = 0x706b6264'4c000002;  // changes with any change of State

/// Names every member once, for writing and for reading.
template <class Archive, class S>
void visit(Archive& io, S& s) {
  io(s.id), io(s.kind), io(s.scale), io(s.fixed), io(s.rotation), io(s.cell), io(s.phase), io(s.guide);
  io(s.waiting);
  io(s.steps), io(s.mean_height), io(s.sinking), io(s.window_since), io(s.at_rest), io(s.waited);
  io(s.snapshots), io(s.wall_s), io(s.cpu_s), io(s.tally);
}

/// Worn pellets cannot be drawn anew.
template <class Archive, class S>
void visit_stamp(Archive& io, S& s) {
  io(s.low), io(s.size), io(s.words), io(s.rows), io(s.count), io(s.bits), io(s.ranges);
}

}  // namespace

std::vector<std::byte> save(const Model& model, const State& state, const Feeder& feeder) {
  return checkpoint_of(kFormat, feeder, [&](ArchiveWriter& io) {
    visit(io, state);
    if (model.rules.turn_cells)
      for (const Stamp& stamp : state.stamp) visit_stamp(io, stamp);
  });
}

void restore(std::span<const std::byte> bytes, const Model& model, State& state, Feeder& feeder) {
  restore_checkpoint(bytes, "lattice packing", kFormat, feeder, [&](ArchiveReader& io) {
    visit(io, state);
    if (!model.rules.turn_cells) return;
    state.stamp.resize(state.size());
    for (Stamp& stamp : state.stamp) visit_stamp(io, stamp);
  });
  StampMaker maker(model.frame.pitch, model.largest);
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (!model.rules.turn_cells)
      state.stamp.push_back(
          maker.make(*model.kind(state.kind[i]).shape, state.scale[i], state.rotation[i], state.phase[i]));
    state.lattice.flip(state.stamp[i], state.cell[i]);
  }
}

}  // namespace packbed::lattice
