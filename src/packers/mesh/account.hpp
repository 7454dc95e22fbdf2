#pragma once
// What a run tells at its end: the bed, the ledgers, and the audit lines that need the packer's own
// knowledge.
#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"
#include "packers/account.hpp"
#include "packers/feed.hpp"
#include "packers/mesh/model.hpp"
#include "packers/packer.hpp"

namespace packbed::mesh {

Pellet pellet_of(const State& state, std::size_t i);

/// The books now. Call with airborne bodies brought to the present time and accounts settled.
Energy energy_of(const Model& model, const State& state);

PackedBed bed_of(const Scene& scene, const Model& model, const State& state);
Snapshot snapshot_of(const Model& model, const State& state, std::vector<Pellet>& pellets);
void fill_record(RunRecord& record, const Scene& scene, const Model& model, const State& state,
                 const Feeder& feeder);

}  // namespace packbed::mesh
