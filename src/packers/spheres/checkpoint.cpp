#include "packers/spheres/checkpoint.hpp"

#include "packers/checkpoint.hpp"

namespace packbed::spheres {
namespace {

constexpr std::uint64_t kFormat = 0x706b6264'53000006;  // changes with any change of State

template <class Archive, class L>
void visit_list(Archive& io, L& list) {
  io(list.block), io(list.first), io(list.slip), io(list.roll), io(list.dash), io(list.filled);
}

/// Names every member once, for writing and for reading.
template <class Archive, class S>
void visit(Archive& io, S& s) {
  io(s.time), io(s.steps);
  auto& b = s.spheres;
  io(b.id), io(b.kind), io(b.scale), io(b.place), io(b.velocity), io(b.spin), io(b.force), io(b.twist),
      io(b.listed_at);
  for (auto& of : s.gear.position) io(of);
  for (auto& of : s.gear.spin) io(of);
  io(s.gear.ahead), io(s.gear.spin_ahead);
  visit_list(io, s.pairs), visit_list(io, s.near), visit_list(io, s.walls);
  visit_list(io, s.still), visit_list(io, s.still_walls);
  visit_list(io, s.late.pairs), visit_list(io, s.late.walls);
  io(s.late.moved), io(s.late.woken), io(s.late.reach);
  auto& z = s.sleepers;
  Sleepers::each_of(z, [&](auto& of) { io(of); });
  io(z.count), io(z.since_search), io(z.sleeps), io(z.wakes), io(z.removed);
  io(s.slot), io(s.slot_first), io(s.first_slot), io(s.tally), io(s.kick_due), io(s.search_due),
      io(s.strayed);
  io(s.searches), io(s.relisted), io(s.flight_steps);
  visit_rest(io, s.rest);
  io(s.waited), io(s.snapshots), io(s.wall_s), io(s.cpu_s), io(s.ledger);
}

}  // namespace

std::vector<std::byte> save(const State& state, const Feeder& feeder) {
  return checkpoint_of(kFormat, feeder, [&](ArchiveWriter& io) { visit(io, state); });
}

void restore(std::span<const std::byte> bytes, State& state, Feeder& feeder) {
  State fresh;
  restore_checkpoint(bytes, "sphere packing", kFormat, feeder, [&](ArchiveReader& io) { visit(io, fresh); });
  state = std::move(fresh);
}

}  // namespace packbed::spheres
