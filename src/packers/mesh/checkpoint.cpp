#include "packers/mesh/checkpoint.hpp"

#include "packers/checkpoint.hpp"

namespace packbed::mesh {
namespace {

constexpr std::uint64_t kFormat = 0x706b6264'0000000c;  // changes with any change of State

/// Names every member once, for writing and for reading.
template <class Archive, class S>
void visit(Archive& io, S& s) {
  io(s.time), io(s.steps);
  auto& b = s.bodies;
  io(b.kind), io(b.inverse_mass), io(b.mass), io(b.inertia), io(b.inverse_inertia), io(b.bounding_radius),
      io(b.scale);
  io(b.position), io(b.rotation), io(b.axis), io(b.velocity), io(b.angular_momentum), io(b.spin),
      io(b.velocity_ahead), io(b.spin_ahead), io(b.travel);
  io(b.force), io(b.torque), io(b.motion);
  io(s.flight_end), io(s.flight_from), io(s.listed_at), io(s.margin), io(s.doze);
  auto& p = s.pairs;
  io(p.pair), io(p.look_at), io(p.load), io(p.record), io(p.slot), io(p.features), io(p.vacant),
      io(p.patches), io(p.active), io(p.first), io(p.entry), io(p.shore), io(p.shore_stale);
  io(s.awake), io(s.next_landing), io(s.search_due);
  visit_rest(io, s.rest);
  visit_shake(io, s.shake);
  io(s.waited), io(s.snapshots), io(s.wall_s), io(s.cpu_s), io(s.ledger);
}

}  // namespace

std::vector<std::byte> save(const State& state, const Feeder& feeder) {
  return checkpoint_of(kFormat, feeder, [&](ArchiveWriter& io) { visit(io, state); });
}

void restore(std::span<const std::byte> bytes, State& state, Feeder& feeder) {
  State fresh;
  restore_checkpoint(bytes, "mesh packing", kFormat, feeder, [&](ArchiveReader& io) { visit(io, fresh); });
  state = std::move(fresh);
  state.pairs.near.resize(state.pairs.patches.size());
}

}  // namespace packbed::mesh
