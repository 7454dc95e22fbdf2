#include "packers/account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace packbed {
namespace {

constexpr double kEnergyLimit = 0.01;  // of the energy put in, that the ledger may miss
constexpr double kForceLimit = 1e-2;   // of the weight, by which base force and wall shear may miss it
constexpr double kDeepShare = 1e-3;    // of touching evaluations that may be deeper than 5 %

}  // namespace

PackedBed bed_of_scene(const Scene& scene, const std::string& kernel) {
  PackedBed bed;
  for (const PelletKind& pellet : scene.pellets) {
    bed.shapes.push_back(pellet.shape);
    bed.densities.push_back(pellet.density);
  }
  bed.container = scene.container;
  bed.provenance = {scene.case_text, scene.case_file, PACKBED_VERSION, scene.method, kernel, scene.seed};
  return bed;
}

Snapshot still_of(double time, const std::vector<Pellet>& pellets) {
  Snapshot shot;
  shot.time = time;
  shot.pellets = &pellets;
  shot.energies.resize(pellets.size());
  return shot;
}

bool inside(const Container& c, const Vec3& x) {
  if (!x.allFinite()) return false;
  if (c.kind == ContainerKind::none) return true;
  if (x.z() < 0) return false;
  if (c.kind == ContainerKind::plane) return true;
  if (c.kind == ContainerKind::tube) return std::hypot(x.x(), x.y()) < c.radius && x.z() < c.height;
  if (c.kind == ContainerKind::box)
    return std::abs(x.x()) < 0.5 * c.width && std::abs(x.y()) < 0.5 * c.depth && x.z() < c.height;
  const Box3 box = bounding_box(c.surface);
  return x.z() < c.height && x.x() > box.min().x() && x.x() < box.max().x() && x.y() > box.min().y() &&
         x.y() < box.max().y();
}

double Energy::error() const {
  const double found = kinetic + potential + elastic + damped + rubbed + removed;
  const double scale = std::max({std::abs(input), kinetic, elastic, 1e-300});
  return std::abs(input - found) / scale;
}

void add_line(RunRecord& record, const char* name, bool passed, const std::string& finding) {
  record.audit.push_back({name, passed, finding});
}

void audit_pellets(RunRecord& record, const Scene& scene, const Feeder& feeder, int within) {
  auto& p = record.pellets;
  p.asked = feeder.asked();
  p.fed = feeder.fed();
  p.inside = within;
  p.escaped = p.fed - p.inside;
  const bool all = p.escaped == 0 && (p.fed == p.asked || (feeder.done() && !scene.feed.count));
  add_line(record, "pellets", all,
           fmt::format("{} asked, {} fed, {} inside, {} escaped", p.asked, p.fed, p.inside, p.escaped));
}

void audit_rest(RunRecord& record, const Stepping& s, const RestWatch& rest) {
  record.at_rest = rest.at_rest != 0;
  if (s.duration > 0) return;
  add_line(record, "rest", record.at_rest,
           fmt::format("speed {:.2g} m/s (limit {:.2g}), unbalanced force {:.2g} of the weight ({:.2g}), "
                       "drift {:.2g} of the size in "
                       "{:.2g} s ({:.2g}), {} still roll",
                       rest.speed, s.rest_speed, rest.force, s.rest_force, rest.drift, s.rest_window,
                       s.rest_drift, rest.rollers));
}

void audit_impacts(RunRecord& record, const Scene& scene, const ImpactCount& i) {
  const double share = i.touches > 0 ? i.deep / i.touches : 0;
  record.overlap.peak = i.peak;
  record.overlap.share_above_5_percent = share;
  add_line(record, "impacts", share <= kDeepShare && i.peak <= scene.impact_limit,
           fmt::format("deepest overlap during the run {:.2f} % (limit {:g} %), {:.4f} % of touches over 5 % "
                       "(limit {:.1f} %)",
                       100 * i.peak, 100 * scene.impact_limit, 100 * share, 100 * kDeepShare));
}

void audit_energy(RunRecord& record, const Energy& e) {
  record.energy = {e.input, e.kinetic, e.potential, e.elastic, e.damped, e.rubbed, e.removed, e.error()};
  add_line(record, "energy", e.error() <= kEnergyLimit,
           fmt::format("ledger closes within {:.3f} % of the {:.4g} J put in (limit {:.0f} %)",
                       100 * e.error(), e.input, 100 * kEnergyLimit));
}

void audit_wall_forces(RunRecord& record, double base, double side, double weight,
                       const Container& container) {
  record.wall = {base, side, weight};
  if (!(weight > 0) || container.kind == ContainerKind::none || !record.at_rest) return;
  const double miss = std::abs(base + side - weight) / weight;
  add_line(record, "wall forces", miss <= kForceLimit,
           fmt::format(
               "base {:.4g} N + side {:.4g} N against a weight of {:.4g} N: {:.3f} % apart (limit {:.0f} %)",
               base, side, weight, 100 * miss, 100 * kForceLimit));
}

}  // namespace packbed
