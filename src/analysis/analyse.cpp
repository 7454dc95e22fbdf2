#include "analysis/analyse.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/axial.hpp"
#include "analysis/bulk.hpp"
#include "analysis/exact_axial.hpp"
#include "analysis/layout.hpp"
#include "analysis/orientation.hpp"
#include "analysis/radial.hpp"
#include "bed/voxelise.hpp"
#include "lattice/count.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Processor time of all threads [s].
double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
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
    case ContainerKind::mesh:
      return 0;
    default:
      return frame.size[0] * frame.pitch * frame.size[1] * frame.pitch;
  }
}

/// The same from the exact shapes. For a container mesh the inside is measured in voxels.
void analyse_exact(const PackedBed& bed, const Layout& layout, AnalysisResult& result) {
  const double area = inside_area(bed.container, layout.frame);
  if (area == 0) return;
  result.axial.exact = slab_volumes(bed, layout.axial_edges);
  for (std::size_t k = 0; k < result.axial.exact.size(); ++k)
    result.axial.exact[k] /= area * (layout.axial_edges[k + 1] - layout.axial_edges[k]);
  const Section& s = layout.section;
  result.bulk.exact = slab_volumes(bed, {s.from, s.to}).front() / (area * (s.to - s.from));
  if (result.axial.density.empty()) result.bulk.axial_sd = sd_in_section(result.axial.exact, layout);
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
  if (wish.voxels) {
    VoxelGrid own;
    VoxelGrid& grid = grid_out ? *grid_out : own;
    grid = voxelise(bed, layout.frame);
    result.voxelise_cpu_s = cpu_seconds() - begin;
    analyse_voxels(grid, container_space(bed.container, layout.frame), layout, result);
  }
  if (wish.exact) analyse_exact(bed, layout, result);
  if (wish.orientation) result.orientation = orientation(bed);
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
  result.bulk.definition = definition_of_density(layout, container, true);
  result.analyse_cpu_s = cpu_seconds() - begin;
  return result;
}

}  // namespace packbed
