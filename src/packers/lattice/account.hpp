#pragma once
// What a run tells at its end: the bed, its grid, and the audit.
#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"
#include "packers/account.hpp"
#include "packers/feed.hpp"
#include "packers/lattice/model.hpp"

namespace packbed::lattice {

PackedBed bed_of(const Model& model, const State& state);
/// The bed's cells in the frame of frame_for(bed, voxel).
VoxelGrid grid_of(const PackedBed& bed, const Model& model, const State& state);
/// The audit takes every pellet off the lattice and lays it again.
void fill_record(RunRecord& record, const Model& model, State& state, const Feeder& feeder);

}  // namespace packbed::lattice
