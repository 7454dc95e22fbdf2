// The voxeliser and the profiles: errors against the voxel, with cost.
#include <fmt/format.h>

#include <cmath>

#include "analysis/analyse.hpp"
#include "bed/voxelise.hpp"
#include "bench/bench.hpp"
#include "bench/scenes.hpp"
#include "bench/statistics.hpp"
#include "contact/cylinder.hpp"
#include "lattice/count.hpp"
#include "math/error.hpp"
#include "math/random.hpp"

namespace packbed::bench {
namespace {

constexpr double kTube = 22.25e-3, kHeight = 30e-3;  // inner radius, height of the bed [m]

Rod rod_of(const Shape& shape, const Pose& pose) {
  return {pose.position, pose.rotation * Vec3::UnitZ(), shape.radius, shape.half_height};
}

/// `count` A38 at random poses in a tube, none touching another or the wall: each tried until it fits.
PackedBed random_bed(int count) {
  PackedBed bed;
  bed.shapes = {make_cylinder("A38", 3.42e-3, 3.46e-3)};
  bed.densities = {kDensity};
  bed.container = make_tube("tube", 2 * kTube, 2 * kHeight);
  const Shape& shape = *bed.shapes.front();
  std::vector<Rod> rods;
  for (std::uint32_t event = 0; static_cast<int>(rods.size()) < count; ++event) {
    Random random(1, Stream::test, event);
    Pellet pellet;
    const double r = kTube * std::sqrt(random.uniform()), phi = random.uniform(0, 2 * kPi);
    pellet.pose = {{r * std::cos(phi), r * std::sin(phi), random.uniform(0, kHeight)}, random.rotation()};
    const Rod rod = rod_of(shape, pellet.pose);
    double gap = 0;
    if (touch_floor(rod, gap).delta > 0 || touch_tube(rod, kTube, gap).delta > 0) continue;
    if (std::any_of(rods.begin(), rods.end(), [&](const Rod& other) { return separation(rod, other) <= 0; }))
      continue;
    pellet.id = static_cast<std::uint32_t>(rods.size());
    rods.push_back(rod);
    bed.pellets.push_back(pellet);
  }
  return bed;
}

double rms_difference(const Profile& profile) {
  std::vector<double> off;
  for (std::size_t k = 0; k < profile.density.size(); ++k)
    if (std::isfinite(profile.density[k]) && std::isfinite(profile.exact[k]))
      off.push_back(profile.density[k] - profile.exact[k]);
  return root_mean_square(off);
}

}  // namespace

Outcome bench_voxels(const Options& options) {
  Outcome out;
  out.table.columns = {"voxel [mm]",
                       "voxels in a diameter",
                       "volume error [-]",
                       "bulk density error [-]",
                       "axial profile, rms error [-]",
                       "radial profile, rms error [-]",
                       "voxelise [CPU s]",
                       "profiles, exact ones included [CPU s]",
                       "bed"};
  const PackedBed bed = random_bed(300);
  const double volume = 300 * bed.shapes.front()->volume;
  Picture picture{"voxels",
                  "300 random A38: profiles from voxels against exact ones",
                  {"CPU time of voxelising [s]", true},
                  {"error (fraction of the volume, or density)", true},
                  {}};
  Series of_volume{"volume", {}, {}, {}, {}}, axial{"axial profile, rms", {}, {}, {}, {}},
      radial{"radial profile, rms", {}, {}, {}, {}};
  for (const double pitch : options.quick ? std::vector{0.8e-3, 0.4e-3, 0.2e-3, 0.1e-3}
                                          : std::vector{0.8e-3, 0.4e-3, 0.2e-3, 0.1e-3, 0.05e-3, 0.025e-3}) {
    options.tell(fmt::format("voxels: {:g} mm", 1e3 * pitch));
    AnalysisWish wish;
    wish.voxel = pitch;
    wish.from_diameters = 1;
    wish.to_diameters = 7;
    wish.orientation = wish.overlap = false;
    VoxelGrid grid;
    const AnalysisResult result = analyse_bed(bed, wish, &grid);
    std::int64_t solid = 0;
    for (const std::int64_t n : slice_counts(grid)) solid += n;
    const double volume_error = std::abs(static_cast<double>(solid) * pitch * pitch * pitch / volume - 1);
    const double of_axial = rms_difference(result.axial), of_radial = rms_difference(result.radial);
    out.table.add(1e3 * pitch, 3.42e-3 / pitch, volume_error,
                  std::abs(result.bulk.packing_density - result.bulk.exact), of_axial, of_radial,
                  result.voxelise_cpu_s, result.analyse_cpu_s, bed_hash(bed));
    for (const auto& [series, y] :
         {std::pair(&of_volume, volume_error), std::pair(&axial, of_axial), std::pair(&radial, of_radial)}) {
      series->x.push_back(result.voxelise_cpu_s);
      series->y.push_back(y);
      series->label.push_back(fmt::format("{:g} mm", 1e3 * pitch));
    }
    if (pitch == 0.1e-3)
      out.findings.push_back(fmt::format(
          "voxels of 0.1 mm: volume within {:.2g}, radial profile within {:.2g} (rms), {:.2g} CPU s",
          volume_error, of_radial, result.voxelise_cpu_s));
  }
  picture.series = {of_volume, axial, radial};
  out.pictures.push_back(picture);
  return out;
}

}  // namespace packbed::bench
