#include "packers/mesh/account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace packbed::mesh {
namespace {

void audit_thin_walls(RunRecord& record, const Model& model, const State& state) {
  if (!(model.thinnest_wall > 0)) return;
  const Ledger& l = state.ledger;
  std::string finding = fmt::format(
      "pressed in by at most {:.2f} % of the thickness (limit {:.0f} %), bodies went at most {:.2f} % "
      "of it in a step (limit {:.0f} %)",
      100 * l.peak, 100 * kPierced, 100 * l.stride, 100 * kMostStride);
  if (l.peak > kPierced)
    finding += fmt::format(
        "; ended at {:.4g} s, before bodies pass through each other: contact.stiffness would "
        "have to be {:.3g} N/m or more",
        state.time, model.pellet_law.stiffness * std::pow(l.peak / (0.5 * kPierced), 2));
  if (l.stride > kMostStride)
    finding += fmt::format(
        "; ended at {:.4g} s, before bodies pass through each other: stepping.step would have "
        "to be {:.3g} us or less",
        state.time, 1e6 * model.step * kMostStride / (2 * l.stride));
  add_line(record, "walls", !pierced(model, state), finding);
}

/// Upward force of floor and sides on the pellets, and the pellets' weight [N].
void audit_walls(RunRecord& record, const Model& model, const State& state) {
  double base = 0, shear = 0, weight = 0;
  const Pairs& pairs = state.pairs;
  for (std::size_t p = 0; p < pairs.pair.size(); ++p) {
    if (!is_container(pairs.pair[p].b)) continue;
    (pairs.pair[p].b == kWall || is_side(pairs.pair[p].b) ? shear : base) +=
        model.up.dot(pairs.load[p].force);
  }
  for (std::size_t i = 0; i < state.bodies.size(); ++i)
    if (state.bodies.motion[i] != Motion::fixed) weight += state.bodies.mass[i] * model.gravity.norm();
  audit_wall_forces(record, base, shear, weight, model.container);
}

}  // namespace

Pellet pellet_of(const State& state, std::size_t i) {
  const Bodies& b = state.bodies;
  Pellet p;
  p.id = static_cast<std::uint32_t>(i);
  p.shape = b.kind[i];
  p.scale = b.scale[i];
  p.pose = {b.position[i], b.rotation[i]};
  p.velocity = b.velocity[i];
  p.spin = spin_of(b, i);  // bodies.spin is of the middle of the step
  p.fixed = b.motion[i] == Motion::fixed;
  return p;
}

Energy energy_of(const Model& model, const State& state) {
  const Bodies& b = state.bodies;
  Energy e;
  e.input = state.ledger.input;
  e.damped = state.ledger.damped;
  e.rubbed = state.ledger.rubbed;
  e.removed = state.ledger.removed;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.motion[i] == Motion::fixed) continue;
    e.kinetic += kinetic_translation(b, i) + kinetic_rotation(b, i);
    e.potential -= b.mass[i] * model.gravity.dot(b.position[i]);
  }
  for (const PairRecord& r : state.pairs.record) e.elastic += r.elastic;
  return e;
}

PackedBed bed_of(const Scene& scene, const Model& model, const State& state) {
  PackedBed bed = bed_of_scene(scene, kernel_name(model));
  for (std::size_t i = 0; i < state.bodies.size(); ++i) bed.pellets.push_back(pellet_of(state, i));
  for (std::size_t p = 0; p < state.pairs.pair.size(); ++p) {
    const Load& load = state.pairs.load[p];
    if (!(load.delta > 0)) continue;
    const auto [a, b] = state.pairs.pair[p];
    const std::uint32_t other = is_container(b) ? kContainer : b;
    if (!uses_fields(model)) {
      bed.contacts.push_back({a, other, state.pairs.record[p].point, load.force, load.delta});
      continue;
    }
    const PatchRecords& patches = state.pairs.patches[p];
    for (std::size_t k = 0; k < patches.count; ++k) {
      const PatchRecord& patch = patches.patch[k];
      bed.contacts.push_back({a, other, patch.mark.centre, patch.force, patch.delta});
    }
  }
  return bed;
}

Snapshot snapshot_of(const Model& model, const State& state, std::vector<Pellet>& pellets) {
  Snapshot shot;
  shot.time = state.time;
  pellets.clear();
  const Bodies& b = state.bodies;
  for (std::size_t i = 0; i < b.size(); ++i) {
    pellets.push_back(pellet_of(state, i));
    shot.energies.push_back(
        {kinetic_translation(b, i), kinetic_rotation(b, i), -b.mass[i] * model.gravity.dot(b.position[i])});
  }
  for (const PairRecord& r : state.pairs.record) shot.elastic += r.elastic;
  shot.pellets = &pellets;
  return shot;
}

void fill_record(RunRecord& record, const Scene& scene, const Model& model, const State& state,
                 const Feeder& feeder) {
  record.method = scene.method;
  record.kernel = kernel_name(model);
  record.seed = scene.seed;
  record.time.steps = state.steps;
  record.time.step_s = model.step;
  record.time.simulated_s = state.time;
  int within = 0;
  for (const Vec3& x : state.bodies.position) within += inside(model.container, x);
  const Ledger& l = state.ledger;
  audit_pellets(record, scene, feeder, within);
  audit_rest(record, model.stepping, state.rest);
  audit_impacts(record, scene, {l.touches, l.deep_touches, l.peak});
  audit_energy(record, energy_of(model, state));
  audit_thin_walls(record, model, state);
  audit_walls(record, model, state);
  const double steps = std::max(1.0, static_cast<double>(state.steps));
  record.counters = {{"touches", l.touches},
                     {"mean_awake", l.awake / steps},
                     {"mean_active_pairs", l.active / steps},
                     {"searches", l.searches},
                     {"wakes", l.wakes},
                     {"sleeps", l.sleeps},
                     {"stiffness_pellet_N_per_m", model.pellet_law.stiffness},
                     {"stiffness_wall_N_per_m", model.wall_law.stiffness}};
  record.taps = state.shake.found;
  if (state.waited) record.notes.push_back("feeding had to wait for room above the bed");
}

}  // namespace packbed::mesh
