#include "packers/mesh/account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace packbed::mesh {
namespace {

constexpr double kEnergyLimit = 0.01;  // of the energy put in, that the ledger may miss
constexpr double kForceLimit = 1e-2;   // of the weight, by which base force and wall shear may miss it
constexpr double kDeepShare = 1e-3;    // of touching evaluations that may be deeper than 5 %

Pellet pellet_of(const State& state, std::size_t i) {
  const Bodies& b = state.bodies;
  Pellet p;
  p.id = static_cast<std::uint32_t>(i);
  p.shape = b.kind[i];
  p.pose = {b.position[i], b.rotation[i]};
  p.velocity = b.velocity[i];
  p.spin = spin_of(b, i);  // bodies.spin is of the middle of the step
  p.fixed = b.motion[i] == Motion::fixed;
  return p;
}

bool inside(const Model& model, const State& state, std::size_t i) {
  const Vec3& x = state.bodies.position[i];
  const Container& c = model.container;
  if (!x.allFinite()) return false;
  if (c.kind == ContainerKind::none) return true;
  if (x.z() < 0) return false;
  if (c.kind == ContainerKind::plane) return true;
  if (c.kind == ContainerKind::tube) return std::hypot(x.x(), x.y()) < c.radius && x.z() < c.height;
  const Box3 box = bounding_box(c.surface);
  return x.z() < c.height && x.x() > box.min().x() && x.x() < box.max().x() && x.y() > box.min().y() &&
         x.y() < box.max().y();
}

void add_line(RunRecord& record, const char* name, bool passed, const std::string& finding) {
  record.audit.push_back({name, passed, finding});
}

void audit_pellets(RunRecord& record, const Scene& scene, const Feeder& feeder) {
  const auto& p = record.pellets;
  const bool all =
      p.escaped == 0 && p.inside == p.fed && (p.fed == p.asked || (feeder.done() && !scene.feed.count));
  add_line(record, "pellets", all,
           fmt::format("{} asked, {} fed, {} inside, {} escaped", p.asked, p.fed, p.inside, p.escaped));
}

void audit_rest(RunRecord& record, const Model& model, const State& state) {
  if (model.stepping.duration > 0) return;  // a run of fixed length does not promise rest
  const Stepping& s = model.stepping;
  add_line(record, "rest", record.at_rest,
           fmt::format("speed {:.2g} m/s (limit {:.2g}), unbalanced force {:.2g} of the weight ({:.2g}), "
                       "drift {:.2g} of the size in "
                       "{:.2g} s ({:.2g}), {} still roll",
                       state.rest_speed, s.rest_speed, state.rest_force, s.rest_force, state.rest_drift,
                       s.rest_window, s.rest_drift, state.rollers));
}

void audit_impacts(RunRecord& record, const State& state) {
  const Ledger& l = state.ledger;
  const double share = l.touches > 0 ? l.deep_touches / l.touches : 0;
  record.overlap.peak = l.peak;
  record.overlap.share_above_5_percent = share;
  add_line(record, "impacts", share <= kDeepShare && l.very_deep_touches <= 0,
           fmt::format("deepest overlap during the run {:.2f} % (limit 10 %), {:.4f} % of touches over 5 % "
                       "(limit {:.1f} %)",
                       100 * l.peak, 100 * share, 100 * kDeepShare));
}

void audit_energy(RunRecord& record, const Model& model, const State& state) {
  const Energy e = energy_of(model, state);
  record.energy = {e.input, e.kinetic, e.potential, e.elastic, e.damped, e.rubbed, e.removed, e.error()};
  add_line(record, "energy", e.error() <= kEnergyLimit,
           fmt::format("ledger closes within {:.3f} % of the {:.4g} J put in (limit {:.0f} %)",
                       100 * e.error(), e.input, 100 * kEnergyLimit));
}

void audit_wall_forces(RunRecord& record, const Model& model, const State& state) {
  double base = 0, shear = 0, weight = 0;
  const Pairs& pairs = state.pairs;
  for (std::size_t p = 0; p < pairs.pair.size(); ++p) {
    if (!is_container(pairs.pair[p].b)) continue;
    (pairs.pair[p].b == kWall ? shear : base) += model.up.dot(pairs.load[p].force);
  }
  for (std::size_t i = 0; i < state.bodies.size(); ++i)
    if (state.bodies.motion[i] != Motion::fixed) weight += state.bodies.mass[i] * model.gravity.norm();
  record.wall = {base, shear, weight};
  if (!(weight > 0) || model.container.kind == ContainerKind::none || !record.at_rest) return;
  const double miss = std::abs(base + shear - weight) / weight;
  add_line(record, "wall forces", miss <= kForceLimit,
           fmt::format(
               "base {:.4g} N + side {:.4g} N against a weight of {:.4g} N: {:.3f} % apart (limit {:.0f} %)",
               base, shear, weight, 100 * miss, 100 * kForceLimit));
}

}  // namespace

double Energy::error() const {
  const double found = kinetic + potential + elastic + damped + rubbed + removed;
  const double scale = std::max({std::abs(input), kinetic, elastic, 1e-300});
  return std::abs(input - found) / scale;
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
  PackedBed bed;
  for (const PelletKind& pellet : scene.pellets) {
    bed.shapes.push_back(pellet.shape);
    bed.densities.push_back(pellet.density);
  }
  bed.container = scene.container;
  for (std::size_t i = 0; i < state.bodies.size(); ++i) bed.pellets.push_back(pellet_of(state, i));
  for (std::size_t p = 0; p < state.pairs.pair.size(); ++p) {
    const Load& load = state.pairs.load[p];
    if (!(load.delta > 0)) continue;
    const auto [a, b] = state.pairs.pair[p];
    bed.contacts.push_back(
        {a, is_container(b) ? kContainer : b, state.pairs.record[p].point, load.force, load.delta});
  }
  bed.provenance = {scene.case_text, scene.case_file,    PACKBED_VERSION,
                    scene.method,    kernel_name(model), scene.seed};
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
  record.at_rest = state.at_rest;
  record.pellets.asked = feeder.asked();
  record.pellets.fed = feeder.fed();
  for (std::size_t i = 0; i < state.bodies.size(); ++i) record.pellets.inside += inside(model, state, i);
  record.pellets.escaped = record.pellets.fed - record.pellets.inside;
  record.time.steps = state.steps;
  record.time.step_s = model.step;
  record.time.simulated_s = state.time;
  audit_pellets(record, scene, feeder);
  audit_rest(record, model, state);
  audit_impacts(record, state);
  audit_energy(record, model, state);
  audit_wall_forces(record, model, state);
  const Ledger& l = state.ledger;
  const double steps = std::max(1.0, static_cast<double>(state.steps));
  record.counters = {{"touches", l.touches},
                     {"mean_awake", l.awake / steps},
                     {"mean_active_pairs", l.active / steps},
                     {"searches", l.searches},
                     {"wakes", l.wakes},
                     {"sleeps", l.sleeps},
                     {"stiffness_pellet_N_per_m", model.pellet_law.stiffness},
                     {"stiffness_wall_N_per_m", model.wall_law.stiffness}};
  if (state.waited) record.notes.push_back("feeding had to wait for room above the bed");
}

}  // namespace packbed::mesh
