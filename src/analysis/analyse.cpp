#include "analysis/analyse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/axial.hpp"
#include "analysis/bins.hpp"
#include "analysis/bulk.hpp"
#include "analysis/coordination.hpp"
#include "analysis/core.hpp"
#include "analysis/exact_axial.hpp"
#include "analysis/exact_radial.hpp"
#include "analysis/layout.hpp"
#include "analysis/orientation.hpp"
#include "analysis/overlap.hpp"
#include "analysis/radial.hpp"
#include "analysis/segregation.hpp"
#include "analysis/size_rows.hpp"
#include "bed/voxelise.hpp"
#include "lattice/count.hpp"
#include "math/clock.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool same_frame(const GridFrame& a, const GridFrame& b) {
  return a.size == b.size && a.pitch == b.pitch && a.origin == b.origin;
}

double wall_radius(const Container& c) {
  return c.kind == ContainerKind::tube || c.kind == ContainerKind::mesh ? c.radius : 0;
}

/// The x axes of a profile, from its edges.
void add_axis(Profile& profile, const std::vector<double>& edges, double diameter) {
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    profile.x_m.push_back((edges[k] + edges[k + 1]) / 2);
    profile.x_dp.push_back(profile.x_m.back() / diameter);
  }
}

void start(const Layout& layout, AnalysisResult& result) {
  result.bulk.z_range_m = {layout.section.from, layout.section.to};
  result.bulk.diameter_m = layout.diameter;
  result.bulk.packing_density = result.bulk.exact = kNaN;
  add_axis(result.axial, layout.axial_edges, layout.diameter);
  if (layout.radius > 0) add_axis(result.radial, layout.ring_edges, layout.diameter);
}

/// Profiles, map and bulk density from voxels.
void analyse_voxels(const VoxelGrid& grid, const VoxelGrid& space, const Layout& layout,
                    AnalysisResult& result) {
  const SliceCounts slices = count_slices(grid, space);
  result.axial.density = axial_profile(slices, layout);
  result.bulk.packing_density = density_of_section(slices, layout);
  result.bulk.axial_sd = sd_in_section(result.axial.density, layout);
  result.bulk.voxel_m = grid.frame.pitch;
  const ColumnCounts columns = count_columns(grid, space, layout);
  if (layout.radius > 0) result.radial.density = radial_profile(columns, layout);
  result.planar = planar_map(columns, layout);
}

/// Cross-section of the inside [m2]; 0 where only voxels could tell.
double inside_area(const Container& container, const GridFrame& frame) {
  switch (container.kind) {
    case ContainerKind::tube:
      return kPi * container.radius * container.radius;
    case ContainerKind::box:
      return container.width * container.depth;
    case ContainerKind::mesh:
      return 0;
    default:
      return frame.size[0] * frame.pitch * frame.size[1] * frame.pitch;
  }
}

/// Takes what pellets share out of the volumes of bins, each overlap where it is.
template <class Where>
void take_overlaps(const std::vector<Overlap>& overlaps, const std::vector<double>& edges,
                   std::vector<double>& volumes, const Where& where) {
  for (const Overlap& o : overlaps) {
    const double at = where(o);
    if (at >= edges.front() && at < edges.back()) volumes[bin_of(edges, at)] -= o.volume;
  }
}

/// Exact curve over the height, and the bulk density. What reaches through the wall (`outside`, within the
/// section) counts in the curve and not in the bulk density.
void exact_axial(const PackedBed& bed, const Layout& layout, const std::vector<Overlap>& overlaps,
                 double outside, AnalysisResult& result) {
  const double area = inside_area(bed.container, layout.frame);
  const auto height = [](const Overlap& o) { return o.point.z(); };
  result.axial.exact = slab_volumes(bed, layout.axial_edges);
  take_overlaps(overlaps, layout.axial_edges, result.axial.exact, height);
  for (std::size_t k = 0; k < result.axial.exact.size(); ++k)
    result.axial.exact[k] /= area * (layout.axial_edges[k + 1] - layout.axial_edges[k]);
  const std::vector<double> section{layout.section.from, layout.section.to};
  std::vector<double> solid = slab_volumes(bed, section);
  take_overlaps(overlaps, section, solid, height);
  result.bulk.exact = (solid.front() - outside) / (area * (section[1] - section[0]));
  if (result.axial.density.empty()) result.bulk.axial_sd = sd_in_section(result.axial.exact, layout);
}

/// Exact curve over the distance from the wall; returns the volume that reaches through it [m3].
double exact_radial(const PackedBed& bed, const Layout& layout, const std::vector<Overlap>& overlaps,
                    AnalysisResult& result) {
  std::vector<double> radii;  // ascending, and one ring more outside the wall
  for (const double e : layout.ring_edges) radii.insert(radii.begin(), layout.radius - e);
  radii.front() = 0;
  double furthest = layout.radius;
  for (const Pellet& p : bed.pellets)
    furthest =
        std::max(furthest, p.pose.position.head<2>().norm() + p.scale * bed.shapes[p.shape]->bounding_radius);
  radii.push_back(furthest + layout.frame.pitch);
  const Section& s = layout.section;
  std::vector<double> volumes = ring_volumes(bed, radii, s.from, s.to);
  take_overlaps(overlaps, radii, volumes, [&](const Overlap& o) {
    return o.point.z() >= s.from && o.point.z() < s.to ? o.point.head<2>().norm() : -1.0;
  });
  const double outside = volumes.back();
  volumes.pop_back();
  for (std::size_t k = 0; k < volumes.size(); ++k)
    volumes[k] /= kPi * (radii[k + 1] * radii[k + 1] - radii[k] * radii[k]) * (s.to - s.from);
  result.radial.exact.assign(volumes.rbegin(), volumes.rend());
  return outside;
}

/// The curves from the exact shapes. The inside of a container mesh is known in voxels only: then there are
/// none.
void analyse_exact(const PackedBed& bed, const Layout& layout, const std::vector<Overlap>& overlaps,
                   AnalysisResult& result) {
  if (bed.container.kind == ContainerKind::mesh) return;
  const double outside = layout.radius > 0 ? exact_radial(bed, layout, overlaps, result) : 0;
  exact_axial(bed, layout, overlaps, outside, result);
}

/// Porosity of the core by every way that the wish and the bed allow.
void analyse_core(const PackedBed& bed, const AnalysisWish& wish, const CoreRegion& core,
                  const VoxelGrid* grid, const std::vector<Overlap>& overlaps, AnalysisResult& result) {
  result.core = start_core(core);
  if (!(core.volume() > 0)) return;
  if (wish.exact) result.core->exact = exact_porosity(bed, core, overlaps);
  if (grid) result.core->voxels = voxel_porosity(*grid, core);
  if (wish.cell > 0) shoot_cells(bed, core, wish.cell, wish.shots, *result.core);
}

/// How sizes and contacts are spread.
void analyse_mixture(const PackedBed& bed, const std::optional<CoreRegion>& core,
                     const std::vector<Overlap>& overlaps, AnalysisResult& result) {
  result.sizes = size_rows(bed);
  result.smallest_m = std::numeric_limits<double>::infinity();
  for (const Pellet& p : bed.pellets) {
    const double size = p.scale * bed.shapes[p.shape]->equivalent_diameter();
    result.smallest_m = std::min(result.smallest_m, size);
    result.largest_m = std::max(result.largest_m, size);
  }
  if (!result.sizes.empty()) result.segregation = segregation(bed);
  if (!bed.contacts.empty() || result.overlap)
    result.coordination = coordination(bed, overlaps, result.sizes, core);
}

}  // namespace

AnalysisResult analyse_bed(const PackedBed& bed, const AnalysisWish& wish, VoxelGrid* grid_out) {
  AnalysisResult result;
  const double begin = cpu_seconds();
  if (bed.pellets.empty()) return result;
  result.bed_height_m = bed_top(bed);
  const Layout layout = lay_out(frame_for(bed, wish.voxel), result.bed_height_m, pellet_diameter(bed, wish),
                                wall_radius(bed.container), wish);
  start(layout, result);
  VoxelGrid own;
  VoxelGrid& grid = grid_out ? *grid_out : own;
  if (wish.voxels) {
    if (!same_frame(grid.frame, layout.frame)) grid = voxelise(bed, layout.frame);
    result.voxelise_cpu_s = cpu_seconds() - begin;
    analyse_voxels(grid, container_space(bed.container, layout.frame), layout, result);
  }
  std::vector<Overlap> overlaps;
  if (wish.overlap) {
    overlaps = find_overlaps(bed);
    result.overlap = audit_overlaps(bed, overlaps);
  }
  if (wish.exact) analyse_exact(bed, layout, overlaps, result);
  if (wish.orientation) result.orientation = orientation(bed);
  std::optional<CoreRegion> core;
  if (wish.core) core = core_region(bed.container, settled_top(bed), core_margin(bed, wish));
  if (core) analyse_core(bed, wish, *core, wish.voxels ? &grid : nullptr, overlaps, result);
  analyse_mixture(bed, core, overlaps, result);
  result.bulk.definition = definition_of_density(layout, bed.container, wish.voxels);
  result.analyse_cpu_s = cpu_seconds() - begin - result.voxelise_cpu_s;
  return result;
}

AnalysisResult analyse_grid(const VoxelGrid& grid, double container_radius, const AnalysisWish& wish) {
  if (!(wish.diameter > 0))
    throw InputError("pellet diameter", fmt::format("{:g} m", wish.diameter), "a positive length",
                     "a grid does not know its pellets: give the diameter that the axes are scaled by");
  AnalysisResult result;
  const double begin = cpu_seconds();
  Container container;
  container.kind = container_radius > 0 ? ContainerKind::tube : ContainerKind::none;
  container.radius = container_radius;
  const std::vector<std::int64_t> solid = slice_counts(grid);
  const auto last = std::find_if(solid.rbegin(), solid.rend(), [](std::int64_t n) { return n > 0; });
  result.bed_height_m = grid.frame.origin.z() + static_cast<double>(solid.rend() - last) * grid.frame.pitch;
  const Layout layout = lay_out(grid.frame, result.bed_height_m, wish.diameter, container_radius, wish);
  start(layout, result);
  analyse_voxels(grid, container_space(container, grid.frame), layout, result);
  const auto core = core_region(container, result.bed_height_m, wish.core_margin * wish.diameter);
  if (wish.core && core) {
    result.core = start_core(*core);
    if (core->volume() > 0) result.core->voxels = voxel_porosity(grid, *core);
  }
  result.bulk.definition = definition_of_density(layout, container, true);
  result.analyse_cpu_s = cpu_seconds() - begin;
  return result;
}

}  // namespace packbed
