#include "packers/lattice/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bed/voxelise.hpp"
#include "lattice/count.hpp"
#include "math/error.hpp"
#include "math/quantity.hpp"

namespace packbed::lattice {
namespace {

std::string length(double metres) {
  return format_quantity(metres, Dimension::length);
}

/// Rounded down to two digits, so that it can be typed.
double round_down(double v) {
  const double unit = std::pow(10, std::floor(std::log10(v)) - 1);
  return std::floor(v / unit * (1 + 1e-9)) * unit;
}

/// A wall of less than two voxels has holes on the lattice, which others may reach through: refused, or noted
/// where the case asks for it.
void check_thickness(const Scene& scene, double voxel, std::vector<std::string>& notes) {
  for (const PelletKind& kind : scene.pellets) {
    const double thin = kind.shape->smallest_thickness * smallest_scale(kind.sizes);
    if (thin >= 2 * voxel * (1 - 1e-9)) continue;
    const std::string found =
        fmt::format("{} for {}, whose thinnest part is {}", length(voxel), kind.shape->name, length(thin));
    const std::string would_do = length(round_down(thin / 2));
    if (!scene.lattice.thin)
      throw InputError("lattice.voxel", found,
                       fmt::format("at most {}: two voxels over the thinnest part", would_do),
                       fmt::format("lattice.voxel = \"{}\", or lattice.thin = true", would_do));
    notes.push_back(
        fmt::format("lattice.thin: a voxel of {}; walls of less than two voxels have holes, and pellets may "
                    "hook into each "
                    "other ({} would do)",
                    found, would_do));
  }
}

/// Height that pellets enter up to [m]; generous, since rows far above the bed cost nothing but memory.
double entry_height(const Scene& scene, double largest) {
  const Feed& feed = scene.feed;
  if (feed.kind == FeedKind::placed) {
    double top = 0;
    for (const PlacedPellet& p : feed.placed) top = std::max(top, p.pose.position.z() + largest);
    return top + largest;
  }
  const double base = feed.drop_height + (feed.above_bed ? scene.container.height : 0.0);
  const double circle = feed.radius > 0 ? feed.radius + largest : scene.container.radius;
  const double per_plane = std::max(1.0, std::floor(0.5 * std::pow(circle / largest, 2)));
  const double planes = feed.kind == FeedKind::layers ? std::ceil(feed.per_layer / per_plane) : 1;
  return base + (2 * planes + 1) * largest;
}

GridFrame lattice_frame(const Scene& scene, double voxel, double largest) {
  GridFrame frame =
      frame_for(scene.container, voxel, std::max(scene.container.height, entry_height(scene, largest)));
  return frame;
}

/// Open cells from the floor to the rim; one slice for a tube.
VoxelGrid open_space(const Scene& scene, GridFrame frame) {
  frame.size[2] = std::clamp(static_cast<int>(scene.container.height / frame.pitch), 1, frame.size[2]);
  return container_space(scene.container, frame);
}

/// The container is open from its lowest open slice to its rim.
bool is_open(const VoxelGrid& space) {
  const std::vector<std::int64_t> open = slice_counts(space);
  const auto lowest = std::find_if(open.begin(), open.end(), [](std::int64_t n) { return n > 0; });
  return lowest != open.end() && std::find(lowest, open.end(), 0) == open.end();
}

double lattice_MB(const GridFrame& frame) {
  return static_cast<double>(frame.words_per_row() + 1) * 8e-6 * frame.size[1] * frame.size[2];
}

void check_memory(const Scene& scene, const GridFrame& frame) {
  const double needs = lattice_MB(frame), limit = scene.lattice.memory_MB;
  if (needs <= limit) return;
  double voxel = frame.pitch;  // rounded up to two digits, until it fits
  GridFrame coarse = frame;
  while (lattice_MB(coarse) > limit) {
    voxel *= std::max(1.02, std::cbrt(lattice_MB(coarse) / limit));
    const double unit = std::pow(10, std::floor(std::log10(voxel)) - 1);
    voxel = std::ceil(voxel / unit * (1 - 1e-9)) * unit;
    for (std::size_t d = 0; d < 3; ++d)
      coarse.size[d] = static_cast<int>(std::ceil(frame.size[d] * frame.pitch / voxel));
  }
  throw InputError("lattice.voxel",
                   fmt::format("{}, which makes a lattice of {} x {} x {} cells, {:.0f} MB",
                               length(frame.pitch), frame.size[0], frame.size[1], frame.size[2], needs),
                   fmt::format("at most {:g} MB (lattice.memory_MB)", limit),
                   fmt::format("lattice.voxel = \"{}\", or a larger lattice.memory_MB", length(voxel)));
}

void check_open(const Scene& scene, const GridFrame& frame, const VoxelGrid& space, double largest) {
  if (is_open(space)) return;
  std::string fix = "no finer one that memory allows opens it either: check the container";
  for (double voxel = frame.pitch / 2; voxel > frame.pitch / 100; voxel /= 2) {
    const GridFrame fine = lattice_frame(scene, round_down(voxel), largest);
    if (lattice_MB(fine) > scene.lattice.memory_MB) break;
    if (!is_open(open_space(scene, fine))) continue;
    fix = fmt::format("lattice.voxel = \"{}\"", length(fine.pitch));
    break;
  }
  throw InputError("lattice.voxel",
                   fmt::format("{}, at which the inside of container {} closes between floor and rim",
                               length(frame.pitch), scene.container.name),
                   "a voxel that leaves the container open", fix);
}

LatticeRules settled(const Scene& scene, double largest) {
  LatticeRules rules = scene.lattice;
  if (!(rules.voxel > 0)) rules.voxel = scene.analysis.voxel;
  // a pellet sinks by 1 - rebound cells a step in free fall; its bounding sphere and a tenth are to be clear
  constexpr double kSlowest = 0.05;  // at a rebound of 1 nothing falls
  if (rules.interval <= 0)
    rules.interval =
        static_cast<int>(std::ceil(2.2 * largest / rules.voxel / std::max(kSlowest, 1 - rules.rebound)));
  return rules;
}

}  // namespace

Model make_model(const Scene& scene) {
  const Container& c = scene.container;
  if (!has_sides(c.kind))
    throw InputError("container", std::string(to_string(c.kind)),
                     "a container with sides (tube, box or mesh) for method " + scene.method,
                     "a lattice ends somewhere: take a tube or a box, or method = \"mesh\"");
  Model model;
  model.scene = &scene;
  model.method = scene.method == "digicgp" ? Method::digicgp : Method::digipac;
  for (const PelletKind& kind : scene.pellets)
    model.largest = std::max(model.largest, kind.shape->bounding_radius * largest_scale(kind.sizes));
  model.rules = settled(scene, model.largest);
  check_thickness(scene, model.rules.voxel, model.notes);
  model.frame = lattice_frame(scene, model.rules.voxel, model.largest);
  check_memory(scene, model.frame);
  model.space = open_space(scene, model.frame);
  check_open(scene, model.frame, model.space, model.largest);
  model.rim = model.space.frame.size[2] - 1;
  if (model.method == Method::digicgp && !model.rules.turn_cells)
    for (const PelletKind& kind : scene.pellets) model.probes.emplace_back(*kind.shape, model.rules.voxel);
  model.step_time = scene.feed.interval / model.rules.interval;
  // bounding spheres of two cells more, for what a pellet may move in one step, on both sides
  model.slab = 2 * static_cast<int>(std::ceil(model.largest / model.rules.voxel)) + 8;
  return model;
}

Spot spot_of(const Model& model, const Vec3& position) {
  const Vec3 at = (position - model.frame.origin) / model.frame.pitch;
  Spot spot;
  for (int d = 0; d < 3; ++d) {
    spot.cell[static_cast<std::size_t>(d)] = static_cast<int>(std::floor(at[d]));
    spot.phase[d] = at[d] - std::floor(at[d]) - 0.5;
  }
  return spot;
}

Pose pose_of(const Model& model, const State& state, std::size_t i) {
  const Cell& c = state.cell[i];
  return {model.frame.centre(c[0], c[1], c[2]) + model.frame.pitch * state.phase[i], state.rotation[i]};
}

std::vector<Pellet> pellets_of(const Model& model, const State& state) {
  std::vector<Pellet> pellets(state.size());
  for (std::size_t i = 0; i < pellets.size(); ++i) {
    Pellet& p = pellets[i];
    p.id = state.id[i];
    p.shape = state.kind[i];
    p.pose = pose_of(model, state, i);
    p.scale = state.scale[i];
    p.fixed = state.fixed[i] != 0;
  }
  return pellets;
}

}  // namespace packbed::lattice
