#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/case.hpp"
#include "math/quantity.hpp"
#include "packers/expect.hpp"
#include "packers/feed.hpp"
#include "packers/packer.hpp"

namespace packbed {
namespace {

using D = Dimension;

// Costs that the estimates rest on; measured on one core of a 2020s server, docs/case.md says how. They
// decide nothing.
constexpr double kContactCost[] = {0.1e-6, 0.35e-6,
                                   4e-6};   // [s] a touching contact and step: sphere, cylinder, field
constexpr double kBodyCost = 0.2e-6;        // [s] a moving pellet and step
constexpr double kContactsPerPellet = 2.3;  // touching, mean over a bed while it is poured
constexpr double kAwake = 0.5;              // share of the pellets that move, with sleep
constexpr double kOffCentre =
    4.4;                           // the effective mass of a rim hit is so much smaller than of a central one
constexpr double kSettling = 0.3;  // [s] from the last landing to rest
constexpr double kPackingDensity = 0.6;
constexpr double kBaseMemory = 40e6, kPelletMemory = 4e3;  // [bytes]

std::string q(double si, D d) {
  return format_quantity(si, d);
}
std::string wall_clock(double s) {
  if (s < 1) return "a second";
  return s < 120    ? fmt::format("{:.0f} s", s)
         : s < 7200 ? fmt::format("{:.0f} min", s / 60)
                    : fmt::format("{:.1f} h", s / 3600);
}

/// What a kernel can do alone; shapes of different kernels, and walls of triangles, are met through the
/// field.
ShapeClass own_kernel(const Scene& s, const Shape& shape) {
  return s.kernel == "field" || seen_as_mesh(shape.kind) ? ShapeClass::mesh : shape.kind;
}
bool mixed_kernels(const Scene& s) {
  return std::any_of(s.pellets.begin(), s.pellets.end(), [&](const PelletKind& k) {
    return own_kernel(s, *k.shape) != own_kernel(s, *s.pellets[0].shape);
  });
}
bool uses_field(const Scene& s, const Shape& shape) {
  if (packs_on_lattice(s.method)) return false;
  return own_kernel(s, shape) == ShapeClass::mesh || s.container.kind == ContainerKind::mesh ||
         mixed_kernels(s);
}
std::string kernel_of(const Scene& s, const Shape& shape) {
  if (packs_on_lattice(s.method)) return "cells";
  return uses_field(s, shape) ? "field" : std::string(to_string(shape.kind));
}
bool any_field(const Scene& s) {
  return std::any_of(s.pellets.begin(), s.pellets.end(),
                     [&](const PelletKind& k) { return uses_field(s, *k.shape); });
}
bool only_spheres(const Scene& s) {
  return std::all_of(s.pellets.begin(), s.pellets.end(),
                     [](const PelletKind& k) { return k.shape->kind == ShapeClass::sphere; });
}
bool has_container(const Scene& s) {
  return s.container.kind != ContainerKind::none;
}
bool round_container(const Scene& s) {
  return s.container.radius > 0 &&
         (s.container.kind == ContainerKind::tube || s.container.kind == ContainerKind::mesh);
}

double mean_volume(const Scene& s) {
  double v = 0;
  for (const PelletKind& k : s.pellets) v += k.share * k.shape->volume * mean_cubed_scale(k.sizes);
  return v;
}
double mean_mass(const Scene& s) {
  double m = 0;
  for (const PelletKind& k : s.pellets)
    m += k.share * k.density * k.shape->volume * mean_cubed_scale(k.sizes);
  return m;
}
double fed_area(const Scene& s) {
  const Container& c = s.container;
  if (c.kind == ContainerKind::box) return c.width * c.depth;
  return kPi * std::pow(round_container(s) ? c.radius : s.feed.radius, 2);
}
/// How many pellets will be there at the end.
double expected_pellets(const Scene& s) {
  if (s.feed.kind == FeedKind::placed) return static_cast<double>(s.feed.placed.size());
  double n = 1e300;
  if (s.feed.count) n = *s.feed.count;
  if (s.feed.mass) n = std::min(n, std::ceil(*s.feed.mass / mean_mass(s)));
  if (s.feed.height) n = std::min(n, kPackingDensity * fed_area(s) * *s.feed.height / mean_volume(s));
  return std::max(1.0, std::floor(n));
}

double expected_height(const Scene& s) {
  if (s.feed.kind == FeedKind::placed) {
    double top = 0;
    for (const PlacedPellet& p : s.feed.placed)
      top = std::max(top, p.pose.position.z() + p.scale * s.pellets[p.kind].shape->bounding_radius);
    return top;
  }
  return expected_pellets(s) * mean_volume(s) / (kPackingDensity * fed_area(s));
}

struct Expected {
  double speed = 0;             // of the hardest impact [m/s]
  double stiffness = 0;         // [N/m]
  double step = 0;              // [s]
  double simulated = 0;         // [s]
  double steps = 0, cpu = 0;    // [-], [s]
  double grid = 0, memory = 0;  // [bytes]
};

double impact_speed(const Scene& s) {
  const double g = s.gravity.norm();
  double speed = 0;
  if (s.feed.kind != FeedKind::placed) return landing_speed(s);
  for (const PlacedPellet& p : s.feed.placed)
    speed = std::max(speed, std::sqrt(p.velocity.squaredNorm() + 2 * g * std::max(0.0, p.pose.position.z())));
  return speed;
}

double lightest(const Scene& s) {
  double mass = 1e300;
  for (const PelletKind& k : s.pellets)
    mass = std::min(mass, k.density * k.shape->volume * std::pow(smallest_scale(k.sizes), 3));
  return mass;
}

/// "The hardest impact of one pellet on a wall may overlap by so much", as the packer finds it.
double stiffness_of(const Scene& s, const ContactLaw& law, double speed) {
  double stiffness = law.stiffness;
  for (const PelletKind& k : s.pellets)
    if (!(law.stiffness > 0))
      stiffness =
          std::max(stiffness, largest_scale(k.sizes) * k.density * k.shape->volume *
                                  std::pow(speed / (law.allowed_overlap * k.shape->smallest_thickness), 2));
  return stiffness;
}

Expected expect(const Scene& s) {
  Expected e;
  e.speed = impact_speed(s);
  e.stiffness = stiffness_of(s, s.pellet_contact, std::max(e.speed, 0.1));
  const double wall = stiffness_of(s, s.wall_contact, std::max(e.speed, 0.1));
  const double contact = kPi * std::sqrt(lightest(s) / std::max(2 * e.stiffness, wall));
  e.step = s.stepping.step > 0 ? s.stepping.step : contact / s.stepping.steps_per_contact;
  if (s.method == "spheres") {
    const SphereNumbers numbers = sphere_numbers(s);
    e.step = numbers.step;
    e.stiffness = numbers.stiffness;
  }
  const double n = expected_pellets(s), g = std::max(s.gravity.norm(), 1e-3);
  const bool placed = s.feed.kind == FeedKind::placed;
  const bool at_once = enters_at_once(s.feed.kind);
  const double feeding = at_once ? 0 : std::ceil(n / s.feed.per_layer - 1) * s.feed.interval;
  const double fall = std::sqrt(2 * (placed ? expected_height(s) : highest_at_entry(s)) / g);
  e.simulated = s.stepping.duration > 0 ? s.stepping.duration
                                        : std::min(s.stepping.max_time, feeding + fall + kSettling);
  e.steps = e.step > 0 ? e.simulated / e.step : 0;
  const double share = at_once ? 1 : (feeding / 2 + fall + kSettling) / std::max(1e-9, e.simulated);
  const double present = n * std::min(1.0, share) * (s.stepping.sleep && n > 200 ? kAwake : 1);
  const double cost = kContactCost[any_field(s) ? 2 : only_spheres(s) ? 0 : 1];
  e.cpu = e.steps * present * (kBodyCost + kContactsPerPellet * cost);
  if (s.analysis.voxels && has_sides(s.container.kind))
    e.grid = fed_area(s) / std::pow(s.analysis.voxel, 3) * expected_height(s) / 8;
  e.memory = kBaseMemory + n * kPelletMemory + e.grid * (s.output.voxels ? 33 : 2);
  return e;
}

std::string size_text(const Shape& shape) {
  if (shape.kind == ShapeClass::sphere) return q(2 * shape.radius, D::length) + " across";
  if (shape.kind == ShapeClass::cylinder)
    return fmt::format("{} x {} (diameter x height)", q(2 * shape.radius, D::length),
                       q(2 * shape.half_height, D::length));
  if (shape.kind == ShapeClass::tube)
    return fmt::format("{} / {} x {} (outer / inner diameter x height)", q(2 * shape.radius, D::length),
                       q(2 * shape.inner_radius, D::length), q(2 * shape.half_height, D::length));
  if (shape.kind == ShapeClass::convex)
    return fmt::format("{} faces, {} across", shape.planes.size(), q(2 * shape.bounding_radius, D::length));
  return fmt::format("{} triangles, {} across", shape.surface.triangles.size(),
                     q(2 * shape.bounding_radius, D::length));
}

std::string sizes_text(const PelletKind& k) {
  if (k.sizes.empty()) return "";
  const double diameter = k.shape->equivalent_diameter();
  if (k.asked.law == SizeLaw::one) return fmt::format("    {} of this size\n", k.sizes[0].count);
  if (k.asked.law != SizeLaw::table)
    return fmt::format("    {} sizes from {} to {}\n", k.sizes.size(),
                       q(smallest_scale(k.sizes) * diameter, D::length),
                       q(largest_scale(k.sizes) * diameter, D::length));
  std::string out;
  for (const SizeClass& c : k.sizes)
    out += fmt::format("    {} of {} ({:.4g} % by number asked)\n", c.count, q(c.scale * diameter, D::length),
                       100 * c.asked);
  return out;
}

std::string pellets_text(const Scene& s) {
  std::string out = "pellets\n";
  for (const PelletKind& k : s.pellets)
    out += fmt::format("  {}: {}, {}; volume {}, mass {}; kernel {}{}\n{}", k.shape->name,
                       to_string(k.shape->kind), size_text(*k.shape), q(k.shape->volume, D::volume),
                       q(k.density * k.shape->volume, D::mass), kernel_of(s, *k.shape),
                       s.pellets.size() > 1 ? fmt::format("; share {:.3g}", k.share) : "", sizes_text(k));
  return out;
}

std::string container_text(const Scene& s) {
  const Container& c = s.container;
  std::string size;
  if (c.kind == ContainerKind::tube)
    size = fmt::format(", inner diameter {}, height {}; exact wall and floor", q(2 * c.radius, D::length),
                       q(c.height, D::length));
  if (c.kind == ContainerKind::box)
    size = fmt::format(", {} x {}, height {}; exact sides and floor", q(c.width, D::length),
                       q(c.depth, D::length), q(c.height, D::length));
  if (c.kind == ContainerKind::mesh)
    size = fmt::format(", {} triangles, height {}; walls through its mesh", c.surface.triangles.size(),
                       q(c.height, D::length));
  const std::string kind(to_string(c.kind));
  return fmt::format("container\n  {}{}\n", c.name == kind || c.name.empty() ? kind : c.name + ": " + kind,
                     size);
}

std::string feed_text(const Scene& s) {
  const Feed& f = s.feed;
  if (f.kind == FeedKind::placed)
    return fmt::format("  {} placed pellet{}, no feeding\n", f.placed.size(),
                       f.placed.size() == 1 ? "" : "s");
  if (f.kind == FeedKind::lattice)
    return fmt::format("  feed: {:.0f} pellets on a cubic lattice from {} above the floor, at the start\n",
                       expected_pellets(s), q(f.drop_height, D::length));
  if (f.kind == FeedKind::scatter)
    return fmt::format(
        "  feed: {:.0f} pellets in a random cloud from {} to {} above the floor, at the start\n",
        expected_pellets(s), q(f.drop_height, D::length), q(highest_at_entry(s), D::length));
  std::vector<std::string> ends;
  if (f.count) ends.push_back(fmt::format("{} pellets", *f.count));
  if (f.height) ends.push_back("a bed of " + q(*f.height, D::length));
  if (f.mass) ends.push_back(q(*f.mass, D::mass) + " of pellets");
  const double layers = std::ceil(expected_pellets(s) / f.per_layer);
  return fmt::format("  feed: {} of {} every {} from {} above the {}, until {}; about {:.0f} {}, {}\n",
                     f.kind == FeedKind::pour ? "handfuls" : "layers", f.per_layer, q(f.interval, D::time),
                     q(f.drop_height, D::length), f.above_bed ? "bed" : "floor", fmt::join(ends, " or "),
                     layers, f.kind == FeedKind::pour ? "handfuls" : "layers",
                     q((layers - 1) * f.interval, D::time));
}

std::string made_text(const Scene& s, const Expected& e) {
  std::string out = "made\n" + feed_text(s);
  for (const PelletKind& k : s.pellets)
    if (uses_field(s, *k.shape))
      out += fmt::format("  {}surface points of {}\n",
                         k.shape->kind == ShapeClass::mesh ? "distance field and " : "", k.shape->name);
  if (s.container.kind == ContainerKind::mesh)
    out += fmt::format("  search structure over the triangles of {}\n", s.container.name);
  if (s.analysis.voxels)
    out += fmt::format("  voxel grid of {} pitch{}\n", q(s.analysis.voxel, D::length),
                       e.grid > 0 ? fmt::format(", about {:.3g} million voxels", e.grid * 8 / 1e6) : "");
  if (s.analysis.exact) out += "  voxel-free profiles\n";
  if (s.output.trajectory_interval > 0) {
    const double frames = e.simulated / s.output.trajectory_interval + 1;
    out += fmt::format("  trajectory: about {:.0f} frames\n", frames);
  }
  if (s.output.report) out += "  report.html\n";
  if (s.output.vtk) out += "  files for ParaView\n";
  if (s.output.voxels) out += "  voxels.h5\n";
  return out;
}

std::string skipped_text(const Scene& s) {
  std::vector<std::string> lines;
  if (!any_field(s)) lines.emplace_back("distance fields: every shape has an exact kernel");
  if (!has_container(s)) lines.emplace_back("container contacts: there is no container");
  if (s.pellet_contact.friction == 0 && s.wall_contact.friction == 0)
    lines.emplace_back("friction history and torsion: friction is 0");
  else if (!s.pellet_contact.torsion && !s.wall_contact.torsion)
    lines.emplace_back("torsion springs: contact.torsion is false");
  if (only_spheres(s) && s.pellet_contact.friction == 0 && s.wall_contact.friction == 0)
    lines.emplace_back("rotations: nothing turns a frictionless sphere");
  if (!s.stepping.sleep) lines.emplace_back("sleep: stepping.sleep is false");
  if (s.feed.kind == FeedKind::placed)
    lines.emplace_back("feeding and its overlap tests: all pellets are placed");
  lines.emplace_back("tetrahedra: no kernel of this scene asks for them");
  if (!s.analysis.voxels) lines.emplace_back("voxel grid: analysis.voxels is false");
  if (!s.analysis.orientation)
    lines.emplace_back("orientations: analysis.orientation is false");
  else if (only_spheres(s))
    lines.emplace_back("orientations: spheres have none");
  if (!s.analysis.exact) lines.emplace_back("voxel-free profiles: analysis.exact is false");
  if (s.analysis.voxels && !round_container(s))
    lines.emplace_back("radial profile: the container has no radius");
  if (!(s.output.trajectory_interval > 0))
    lines.emplace_back("trajectory: output.trajectory_interval is auto (none)");
  if (!(s.output.checkpoint_interval > 0)) lines.emplace_back("checkpoints: output.checkpoint_interval is 0");
  std::string out = "not needed, skipped\n";
  for (const std::string& line : lines) out += "  " + line + "\n";
  return out;
}

std::string expected_text(const Scene& s, const Expected& e) {
  return fmt::format(
      "expected (estimates)\n"
      "  pellets {:.0f}, bed height {}\n"
      "  hardest impact {}, stiffness {}{}\n"
      "  step {}{}, simulated {}, {:.3g} steps\n"
      "  time about {} of one core, memory about {:.0f} MB\n",
      expected_pellets(s),
      fed_area(s) > 0 || s.feed.kind == FeedKind::placed ? q(expected_height(s), D::length) : "unknown",
      q(e.speed, D::speed), q(e.stiffness, D::stiffness),
      s.pellet_contact.stiffness > 0 ? " (given)"
      : s.pellet_contact.youngs_modulus > 0
          ? " (of the smallest pellets, from youngs_modulus)"
          : fmt::format(" (from an allowed overlap of {:.3g} %)", 100 * s.pellet_contact.allowed_overlap),
      q(e.step, D::time),
      s.stepping.step > 0 ? " (given)"
                          : fmt::format(" (stiffest contact / {:.3g})", s.stepping.steps_per_contact),
      format_quantity(e.simulated, D::time, 3), e.steps, wall_clock(e.cpu), e.memory / 1e6);
}

/// The lattice and a pellet on it, in cells.
std::string lattice_text(const Scene& s) {
  const double voxel = s.lattice.voxel > 0 ? s.lattice.voxel : s.analysis.voxel;
  const double wide = round_container(s) ? 2 * s.container.radius / voxel : 0,
               high = s.container.height / voxel;
  std::string out =
      fmt::format("lattice\n  voxel {}, about {:.0f} x {:.0f} x {:.0f} cells, {:.3g} MB (limit {:g})\n",
                  q(voxel, D::length), wide, wide, high, wide * wide * high / 8e6, s.lattice.memory_MB);
  for (const PelletKind& k : s.pellets)
    out += fmt::format("  {}: {:.0f} cells, {:.3g} over its thinnest part\n", k.shape->name,
                       k.shape->volume / std::pow(voxel, 3), k.shape->smallest_thickness / voxel);
  return out;
}

}  // namespace

std::string plan(const Scene& scene) {
  if (packs_on_lattice(scene.method)) {
    Expected cells;  // the mesh packer's forces and steps say nothing here
    return fmt::format("plan of \"{}\": method {}, seed {}\n", scene.name, scene.method, scene.seed) +
           pellets_text(scene) + container_text(scene) + made_text(scene, cells) + lattice_text(scene);
  }
  const Expected e = expect(scene);
  return fmt::format("plan of \"{}\": method {}, kernel {}, seed {}\n", scene.name, scene.method,
                     scene.kernel, scene.seed) +
         pellets_text(scene) + container_text(scene) + made_text(scene, e) + skipped_text(scene) +
         expected_text(scene, e);
}

}  // namespace packbed
