#pragma once
// What every run tells at its end: the bed without its pellets, and the audit lines that packers share.
#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"
#include "packers/feed.hpp"
#include "packers/packer.hpp"
#include "packers/rest_watch.hpp"

namespace packbed {

/// Shapes, container and provenance; no pellets yet.
PackedBed bed_of_scene(const Scene& scene, const std::string& kernel);

/// Of pellets whose energies are not known.
Snapshot still_of(double time, const std::vector<Pellet>& pellets);

/// Whether a centre is within the container's sides, above its floor and below its rim.
bool inside(const Container& container, const Vec3& x);

/// Energy books [J]. input = kinetic + potential + elastic + damped + rubbed + removed, but for the error of
/// stepping.
struct Energy {
  double input = 0, kinetic = 0, potential = 0, elastic = 0, damped = 0, rubbed = 0, removed = 0;
  double error() const;  // |unaccounted| / input
};

/// Touching evaluations of a run.
struct ImpactCount {
  double touches = 0, deep = 0;  // all; deeper than 5 % of the thickness
  double peak = 0;               // greatest depth, fraction of the thickness
};

void add_line(RunRecord& record, const char* name, bool passed, const std::string& finding);
/// Fills the record's pellet counts; `within` of them are inside the container.
void audit_pellets(RunRecord& record, const Scene& scene, const Feeder& feeder, int within);
/// A run of fixed length does not promise rest.
void audit_rest(RunRecord& record, const Stepping& stepping, const RestWatch& rest);
void audit_impacts(RunRecord& record, const Scene& scene, const ImpactCount& impacts);
void audit_energy(RunRecord& record, const Energy& energy);
/// Upward forces on the pellets from floor and sides against their weight [N].
void audit_wall_forces(RunRecord& record, double base, double side, double weight,
                       const Container& container);

}  // namespace packbed
