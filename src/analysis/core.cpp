#include "analysis/core.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/bins.hpp"
#include "bed/voxelise.hpp"
#include "geometry/sphere_volume.hpp"
#include "lattice/count.hpp"

namespace packbed {
namespace {

Box3 box_of(const CoreRegion& c) {
  return {Vec3(-c.half.x(), -c.half.y(), c.from), Vec3(c.half.x(), c.half.y(), c.to)};
}

double sphere_in_core(const Vec3& centre, double radius, const CoreRegion& c) {
  return c.radius > 0 ? sphere_in_cylinder(centre, radius, c.radius, c.from, c.to)
                      : sphere_in_box(centre, radius, box_of(c));
}

/// Cells of one slice of the frame that lie in the core with all their corners (whole) or with their centre.
std::vector<std::uint8_t> cells_inside(const GridFrame& f, const CoreRegion& c, bool whole) {
  std::vector<std::uint8_t> inside;
  const double reach = whole ? 0.5 * f.pitch * (1 - 1e-9) : 0;
  for (int y = 0; y < f.size[1]; ++y)
    for (int x = 0; x < f.size[0]; ++x) {
      const Vec2 at =
          (f.origin.head<2>() + f.pitch * Vec2(x + 0.5, y + 0.5)).cwiseAbs() + Vec2::Constant(reach);
      inside.push_back(c.radius > 0 ? at.norm() <= c.radius : (at.array() <= c.half.array()).all());
    }
  return inside;
}

/// Whole cells of the core, from its floor upwards.
GridFrame cell_frame(const CoreRegion& c, double cell) {
  GridFrame frame;
  frame.pitch = cell;
  const Vec2 half = c.radius > 0 ? Vec2::Constant(c.radius) : c.half;
  const Vec3 room(2 * half.x(), 2 * half.y(), c.to - c.from);
  for (int d = 0; d < 3; ++d)
    frame.size[static_cast<std::size_t>(d)] =
        std::max(0, static_cast<int>(std::floor(room[d] / cell * (1 + 1e-9))));
  frame.origin = Vec3(-0.5 * frame.size[0] * cell, -0.5 * frame.size[1] * cell, c.from);
  return frame;
}

}  // namespace

double CoreRegion::volume() const {
  if (!(to > from)) return 0;
  if (radius > 0) return kPi * radius * radius * (to - from);
  return half.minCoeff() > 0 ? 4 * half.x() * half.y() * (to - from) : 0;
}

bool CoreRegion::holds(const Vec3& x) const {
  if (x.z() < from || x.z() > to) return false;
  return radius > 0 ? x.head<2>().norm() <= radius : (x.head<2>().cwiseAbs().array() <= half.array()).all();
}

std::optional<CoreRegion> core_region(const Container& container, double top, double margin) {
  if (!has_sides(container.kind) || !(container.radius > 0) || container.core_radius > 0) return {};
  CoreRegion core;
  core.margin = margin;
  core.from = margin;
  core.to = top - margin;
  if (container.kind == ContainerKind::box)
    core.half = (0.5 * Vec2(container.width, container.depth) - Vec2::Constant(margin)).cwiseMax(0.0);
  else
    core.radius = container.radius - margin;
  if (!(core.radius > 0)) core.radius = 0;  // and half is 0 too: a core without volume
  return core;
}

double core_margin(const PackedBed& bed, const AnalysisWish& wish) {
  double largest = 0;
  for (const Pellet& p : bed.pellets)
    largest = std::max(largest, p.scale * bed.shapes[p.shape]->equivalent_diameter());
  return wish.core_margin * largest;
}

double exact_porosity(const PackedBed& bed, const CoreRegion& core, const std::vector<Overlap>& overlaps) {
  for (const Pellet& p : bed.pellets)
    if (bed.shapes[p.shape]->kind != ShapeClass::sphere) return kNone;
  const std::vector<double> solid =
      gather_in_bins(bed.pellets.size(), 1, [&](std::size_t i, std::vector<double>& sum) {
        const Pellet& p = bed.pellets[i];
        sum[0] += sphere_in_core(p.pose.position, p.scale * bed.shapes[p.shape]->radius, core);
      });
  double shared = 0;
  for (const Overlap& o : overlaps)
    if (o.b != kContainer && core.holds(o.point)) shared += o.volume;
  return 1 - (solid[0] - shared) / core.volume();
}

double voxel_porosity(const VoxelGrid& grid, const CoreRegion& core) {
  const GridFrame& f = grid.frame;
  VoxelGrid section(GridFrame{f.origin, f.pitch, {f.size[0], f.size[1], 1}});  // stands for all slices
  const std::vector<std::uint8_t> inside = cells_inside(f, core, false);
  const std::size_t nx = static_cast<std::size_t>(f.size[0]);
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (inside[i])
      section.words[section.row(static_cast<int>(i / nx), 0) + i % nx / 64] |= std::uint64_t{1}
                                                                               << (i % nx % 64);
  const std::vector<std::int64_t> solid = slice_counts(grid, section);
  const std::int64_t per_slice = slice_counts(section).front();
  std::int64_t filled = 0, all = 0;
  for (int z = 0; z < f.size[2]; ++z) {
    const double height = f.origin.z() + (z + 0.5) * f.pitch;
    if (height < core.from || height > core.to) continue;
    all += per_slice;
    filled += solid[static_cast<std::size_t>(z)];
  }
  return all > 0 ? 1 - static_cast<double>(filled) / static_cast<double>(all) : kNone;
}

void shoot_cells(const PackedBed& bed, const CoreRegion& core, double cell, int n, CorePorosity& out) {
  const GridFrame frame = cell_frame(core, cell);
  out.cell_m = cell;
  out.shots_per_cell = n * n * n;
  if (frame.size[0] * frame.size[1] * frame.size[2] == 0) return;
  const std::vector<std::uint8_t> inside = cells_inside(frame, core, true);
  double sum = 0, squares = 0, variance = 0;
  GridFrame some = frame;  // levels that partial_volume takes at once: memory stays small
  for (int z = 0; z < frame.size[2]; z += some.size[2]) {
    some.size[2] = std::min(std::max(1, 64 / n), frame.size[2] - z);
    some.origin.z() = frame.origin.z() + z * cell;
    const std::vector<float> solid = partial_volume(bed, some, n);
    for (std::size_t i = 0; i < solid.size(); ++i) {
      if (!inside[i % inside.size()]) continue;
      const double porosity = 1 - static_cast<double>(solid[i]);
      ++out.cells;
      sum += porosity;
      squares += porosity * porosity;
      variance += porosity * (1 - porosity);  // of one shot
    }
  }
  if (out.cells == 0) return;
  const double cells = static_cast<double>(out.cells);
  out.shots = sum / cells;
  out.cell_sd = std::sqrt(std::max(0.0, squares / cells - out.shots * out.shots));
  out.shots_error = std::sqrt(variance / out.shots_per_cell) / cells;
}

CorePorosity start_core(const CoreRegion& core) {
  CorePorosity out;
  out.margin_m = core.margin;
  out.z_range_m = {core.from, core.to};
  out.volume_m3 = core.volume();
  if (!(out.volume_m3 > 0)) {
    out.z_range_m = {0, 0};
    out.definition = fmt::format("the bed is too small for a core {:.4g} mm away from walls, floor and top",
                                 1e3 * core.margin);
    return out;
  }
  const std::string across = core.radius > 0 ? fmt::format("within {:.4g} mm of the axis", 1e3 * core.radius)
                                             : fmt::format("{:.4g} x {:.4g} mm about the axis",
                                                           2e3 * core.half.x(), 2e3 * core.half.y());
  out.definition = fmt::format(
      "share of void in the core, {:.4g} mm away from walls, floor and top: {}, from {:.4g} to {:.4g} mm "
      "above "
      "the floor",
      1e3 * core.margin, across, 1e3 * core.from, 1e3 * core.to);
  return out;
}

double CorePorosity::best() const {
  return std::isfinite(exact) ? exact : std::isfinite(voxels) ? voxels : shots;
}

}  // namespace packbed
