#pragma once
// What a run of spheres tells at its end: the bed, the ledgers, and the audit.
#include "packers/account.hpp"
#include "packers/spheres/model.hpp"

namespace packbed::spheres {

/// By pellet id.
std::vector<Pellet> pellets_of(const State& state);
PackedBed bed_of(const Scene& scene, const Model& model, State& state);
Snapshot snapshot_of(const Model& model, State& state, std::vector<Pellet>& pellets);
/// Call with accounts settled.
void fill_record(RunRecord& record, const Scene& scene, const Model& model, State& state,
                 const Feeder& feeder);

}  // namespace packbed::spheres
