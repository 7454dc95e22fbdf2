// VTK (the library of ParaView) and h5py read what packbed writes, and see the same bed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

#include "bed/voxelise.hpp"
#include "command.hpp"
#include "io/bed.hpp"
#include "io/grid.hpp"
#include "io/sample_bed.hpp"
#include "io/temporary_folder.hpp"
#include "io/trajectory.hpp"
#include "io/vtu.hpp"
#include "lattice/count.hpp"

namespace packbed {
namespace {

constexpr int kNotInstalled = 77;

struct Seen {
  int exit_code = 0;
  std::string output;
  std::map<std::string, std::string> values;
  double number(const std::string& key) { return std::stod(values[key]); }
};

Seen seen_by_others(const std::string& folder) {
  const Ran ran = run_command(PACKBED_PYTHON " " PACKBED_SOURCE_DIR "/tests/io/readable_by_others " + folder);
  Seen seen{ran.code, ran.output, {}};
  std::istringstream lines(ran.output);
  for (std::string text; std::getline(lines, text);)
    if (const std::size_t gap = text.find(' '); gap != std::string::npos)
      seen.values[text.substr(0, gap)] = text.substr(gap + 1);
  return seen;
}

TEST(OtherPrograms, SeeTheSameBed) {
  const TemporaryFolder folder;
  const PackedBed bed = sample_bed(40);
  const AnalysisResult analysis = sample_analysis(bed);
  write_bed(folder / "bed.h5", bed);
  write_vtu(folder / "bed.vtu", bed, {analysis.overlap->pellet});
  write_container_vtu(folder / "container.vtu", bed.container);
  write_point_vtu(folder / "points.vtu", bed.pellets);
  const VoxelGrid voxels = voxelise(bed, frame_for(bed, 0.5e-3), true);
  write_grid(folder / "voxels.h5", voxels, {});
  TrajectoryWriter trajectory({folder.path()}, bed.shapes, 40);
  for (const double t : {0.0, 0.1, 0.2}) trajectory.add({t, &bed.pellets, {}, 0});
  trajectory.finish();

  Seen seen = seen_by_others(folder.path());
  if (seen.exit_code == kNotInstalled)
    GTEST_SKIP() << "python3-vtk9 and python3-h5py are not installed: " << seen.output;
  ASSERT_EQ(seen.exit_code, 0) << seen.output;
  EXPECT_EQ(seen.values["arrays"], "angle_deg,height_m,overlap,pellet,shape");
  EXPECT_EQ(seen.number("pellets"), 40);
  const auto& size = voxels.frame.size;
  EXPECT_EQ(seen.values["voxels"], fmt::format("{} {} {}", size[0], size[1], size[2]));
  EXPECT_EQ(seen.number("voxel_pitch"), 0.5e-3);
  EXPECT_NEAR(seen.number("first_voxel_z"), 0.25e-3, 1e-12);
  const auto slices = slice_counts(voxels);
  const auto solid = std::accumulate(slices.begin(), slices.end(), std::int64_t{0});
  EXPECT_EQ(seen.number("solid_voxels"), static_cast<double>(solid));
  EXPECT_EQ(seen.number("labelled_voxels"), static_cast<double>(solid));
  // the prisms that are drawn hold the cylinders' volume; single precision of the points moves it by 1e-5
  EXPECT_NEAR(seen.number("volume") / (40 * bed.shapes[0]->volume), 1, 1e-4);
  EXPECT_NEAR(seen.number("largest_overlap"),
              *std::max_element(analysis.overlap->pellet.begin(), analysis.overlap->pellet.end()), 1e-9);
  double largest_angle = 0;
  for (const Pellet& p : bed.pellets) largest_angle = std::max(largest_angle, angle_to_vertical_deg(p));
  EXPECT_NEAR(seen.number("largest_angle"), largest_angle, 1e-4);
  EXPECT_NEAR(seen.number("container_radius"), bed.container.radius, 0.01 * bed.container.radius);
  EXPECT_EQ(seen.number("points"), 40);
  EXPECT_EQ(seen.number("quaternion_components"), 4);
  EXPECT_EQ(seen.number("h5_pellets"), 40);
  EXPECT_EQ(seen.values["h5_case"], "name = \"sample\"");
  EXPECT_EQ(seen.number("h5_frames"), 3);
  EXPECT_EQ(seen.values["h5_rows"], "120 120");
}

TEST(OtherPrograms, AngleToTheVerticalIsExactAtBothEnds) {
  Pellet p;
  EXPECT_EQ(angle_to_vertical_deg(p), 0);
  p.pose.rotation = Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()));
  EXPECT_NEAR(angle_to_vertical_deg(p), 90, 1e-12);
  p.pose.rotation = Quat(Eigen::AngleAxisd(kPi - 1e-9, Vec3::UnitY()));
  EXPECT_NEAR(angle_to_vertical_deg(p), 1e-9 * 180 / kPi, 1e-13)
      << "small angles keep their digits, upside down is upright";
}

}  // namespace
}  // namespace packbed
