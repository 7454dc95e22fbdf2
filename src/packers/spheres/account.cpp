#include "packers/spheres/account.hpp"

#include <algorithm>
#include <cmath>

#include "packers/spheres/chunks.hpp"
#include "packers/spheres/step.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed::spheres {
namespace {

List joined(List a, const List& b) {
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(a.block, b.block), add(a.slip, b.slip), add(a.roll, b.roll), add(a.dash, b.dash);
  return a;
}

/// All listed contacts as they are now; nothing moves on.
struct Contacts {
  List pair_list, wall_list;
  std::vector<SphereContact> pairs, walls;  // an entry a lane
  std::vector<Quad> sides;                  // of a mesh container: see sides_of
};
Contacts contacts_of(const Model& model, State& state) {
  Spheres& s = state.spheres;
  Contacts out{joined(joined(joined(state.pairs, state.near), state.late.pairs), state.still),
               joined(joined(state.walls, state.late.walls), state.still_walls),
               {},
               {},
               {}};
  out.pairs.resize(out.pair_list.lanes());
  out.walls.resize(out.wall_list.lanes());
  SphereTally unused;
  const std::size_t walls = out.wall_list.block.size();
  fastest_sphere_loops().touch_spheres({model.pellet_law, view_of(s), 0.0, out.pair_list.block,
                                        out.pair_list.memory_from(0), unused, out.pairs.data()});
  touch_container_walls(model, s, out.wall_list, 0.0, 0, walls, unused, out.walls.data());
  if (model.solid) out.sides = sides_of(model, s, out.wall_list, 0, walls);
  return out;
}

PelletEnergy energy_of(const Model& model, const Spheres& s, std::size_t i) {
  const Quad &v = s.velocity[i], &w = s.spin[i];
  if (!(v.w > 0)) return {};
  return {0.5 * vec(v).squaredNorm() / v.w, 0.5 * vec(w).squaredNorm() / w.w,
          -model.gravity.dot(vec(s.place[i])) / v.w};
}

double elastic_in(const Contacts& contacts) {
  double sum = 0;
  for (const SphereContact& c : contacts.pairs) sum += c.elastic;
  for (const SphereContact& c : contacts.walls) sum += c.elastic;
  return sum;
}

Energy books_of(const Model& model, const State& state, const Contacts& contacts) {
  Energy e;
  e.input = state.ledger.input;
  e.damped = state.ledger.damped;
  e.rubbed = state.ledger.rubbed;
  e.removed = state.sleepers.removed;
  for (std::size_t i = 0; i < state.spheres.size(); ++i) {
    const PelletEnergy of = energy_of(model, state.spheres, i);
    e.kinetic += of.translation + of.rotation;
    e.potential += of.height;
  }
  e.elastic = elastic_in(contacts);
  return e;
}

/// Time of a contact but for a factor that all share [s].
double contact_time(const SphereLaw& law, const Quad& place_a, const Quad& place_b, double lightness) {
  const double radius = place_a.w * place_b.w / (place_a.w + place_b.w);
  return std::sqrt(1.0 /
                   (lightness * elastic_of(law, law.hertz, four(radius), four(0.01 * radius)).slope[0]));
}

/// The most that block time steps could save: contacts over how many of them there would be a step if each
/// were looked at as seldom as its size allows, by powers of two.
double gain_of_block_steps(const Model& model, const Spheres& s, const Contacts& contacts) {
  std::vector<double> times;
  for (std::size_t p = 0; p < contacts.pairs.size(); ++p) {
    if (!(contacts.pairs[p].force.w > 0)) continue;
    const std::uint32_t a = contacts.pair_list.a(p), b = contacts.pair_list.b(p);
    times.push_back(
        contact_time(model.pellet_law, s.place[a], s.place[b], s.velocity[a].w + s.velocity[b].w));
  }
  if (times.empty()) return 1;
  const double shortest = *std::min_element(times.begin(), times.end());
  double looks = 0;
  for (const double time : times) looks += std::exp2(-std::floor(std::log2(time / shortest) + 1e-9));
  return static_cast<double>(times.size()) / looks;
}

void audit_walls(RunRecord& record, const Model& model, const State& state, const Contacts& contacts) {
  double base = 0, side = 0, weight = 0;
  for (std::size_t p = 0; p < contacts.walls.size(); ++p)
    (contacts.wall_list.b(p) == 0 ? base : side) += model.up.dot(vec(contacts.walls[p].force));
  for (const Quad& v : state.spheres.velocity)
    if (v.w > 0) weight += model.gravity.norm() / v.w;
  audit_wall_forces(record, base, side, weight, model.container);
}

}  // namespace

std::vector<Pellet> pellets_of(const State& state) {
  const Spheres& s = state.spheres;
  std::vector<Pellet> pellets(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    Pellet& p = pellets[s.id[i]];
    p.id = s.id[i];
    p.shape = s.kind[i];
    p.scale = s.scale[i];
    p.pose.position = vec(s.place[i]);
    p.velocity = vec(s.velocity[i]);
    p.spin = vec(s.spin[i]);
    p.fixed = !(s.velocity[i].w > 0);
  }
  return pellets;
}

PackedBed bed_of(const Scene& scene, const Model& model, State& state) {
  finish_kick(model, state);
  PackedBed bed = bed_of_scene(scene, "sphere");
  bed.pellets = pellets_of(state);
  const Contacts contacts = contacts_of(model, state);
  const Spheres& s = state.spheres;
  // the point lies in the middle of the overlap, on the line along which the overlap is measured
  for (std::size_t p = 0; p < contacts.pairs.size(); ++p) {
    const SphereContact& c = contacts.pairs[p];
    if (!(c.force.w > 0)) continue;
    const std::uint32_t a = contacts.pair_list.a(p), b = contacts.pair_list.b(p);
    const Vec3 xa = vec(s.place[a]), xb = vec(s.place[b]), normal = (xa - xb).normalized();
    const Vec3 point = xa - (s.place[a].w - 0.5 * c.force.w) * normal, force = vec(c.force);
    const bool ascending = s.id[a] < s.id[b];
    bed.contacts.push_back({std::min(s.id[a], s.id[b]), std::max(s.id[a], s.id[b]), point,
                            ascending ? force : Vec3(-force), c.force.w});
  }
  for (std::size_t p = 0; p < contacts.walls.size(); ++p) {
    const SphereContact& c = contacts.walls[p];
    if (!(c.force.w > 0)) continue;
    const std::uint32_t a = contacts.wall_list.a(p), w = contacts.wall_list.b(p);
    const Vec3 x = vec(s.place[a]), flat = vec(model.solid ? contacts.sides[p] : model.walls[w]);
    const Vec3 normal = flat.squaredNorm() > 0.5 ? flat : Vec3(-x.x(), -x.y(), 0).normalized();
    bed.contacts.push_back(
        {s.id[a], kContainer, x - (s.place[a].w - 0.5 * c.force.w) * normal, vec(c.force), c.force.w});
  }
  std::sort(bed.contacts.begin(), bed.contacts.end(),
            [](const Contact& a, const Contact& b) { return a.a != b.a ? a.a < b.a : a.b < b.b; });
  return bed;
}

Snapshot snapshot_of(const Model& model, State& state, std::vector<Pellet>& pellets) {
  finish_kick(model, state);
  pellets = pellets_of(state);
  Snapshot shot = still_of(state.time, pellets);
  for (std::size_t i = 0; i < state.spheres.size(); ++i)
    shot.energies[state.spheres.id[i]] = energy_of(model, state.spheres, i);
  shot.elastic = elastic_in(contacts_of(model, state));
  return shot;
}

void fill_record(RunRecord& record, const Scene& scene, const Model& model, State& state,
                 const Feeder& feeder) {
  finish_kick(model, state);
  record.method = scene.method;
  record.kernel = "sphere";
  record.seed = scene.seed;
  record.time.steps = state.steps;
  record.time.step_s = model.step;
  record.time.simulated_s = state.time;
  int within = 0;
  for (const Quad& x : state.spheres.place) within += inside(model.container, vec(x));
  const auto& l = state.ledger;
  const Contacts contacts = contacts_of(model, state);
  audit_pellets(record, scene, feeder, within);
  audit_rest(record, model.stepping, state.rest);
  audit_impacts(record, scene, {l.touches, l.deep, l.peak});
  audit_energy(record, books_of(model, state, contacts));
  audit_walls(record, model, state, contacts);
  const double steps = std::max(1.0, static_cast<double>(state.steps));
  record.counters = {
      {"touches", l.touches},
      {"mean_listed_pairs", l.listed / steps},
      {"sleeps", state.sleepers.sleeps},
      {"wakes", state.sleepers.wakes},
      {"searches", static_cast<double>(state.searches)},
      {"spheres_listed_between_searches", static_cast<double>(state.relisted)},
      {"most_that_block_steps_would_save", gain_of_block_steps(model, state.spheres, contacts)},
      {"stiffness_pellet_N_per_m", model.pellet_law.stiffness},
      {"stiffness_wall_N_per_m", model.wall_law.stiffness},
      {"modulus_pellet_Pa", model.pellet_law.modulus},
      {"modulus_wall_Pa", model.wall_law.modulus}};
  if (state.waited) record.notes.push_back("feeding had to wait for room above the bed");
}

}  // namespace packbed::spheres
