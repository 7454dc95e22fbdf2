// A finished run leaves every file that docs/results.md names, and summary.json only when all others are
// there.
#include "io/results.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/atomic_file.hpp"
#include "io/sample_bed.hpp"
#include "io/temporary_folder.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

TEST(Results, HoldWhatTheCaseWishes) {
  const TemporaryFolder folder;
  const PackedBed bed = sample_bed(20);
  Scene scene = sample_scene();
  scene.output.voxels = true;
  VoxelGrid grid(GridFrame{Vec3::Zero(), 1e-3, {4, 4, 4}});
  write_atomically(folder / "checkpoint.bin", "x");
  const std::string report =
      write_results({folder.path()}, scene, bed, sample_record(), sample_analysis(bed), &grid);
  EXPECT_EQ(report, folder / "report.html");
  for (const char* name :
       {"summary.json", "bed.h5", "poses.csv", "axial.csv", "radial.csv", "planar.csv", "orientation.csv",
        "angles.csv", "voxels.h5", "bed.vtu", "container.vtu", "report.html"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_EQ(folder.count(), 12) << "and nothing else: the checkpoint of a finished run is gone";
}

TEST(Results, SkipWhatTheCaseDoesNotWish) {
  const TemporaryFolder folder;
  const PackedBed bed = sample_bed(20);
  Scene scene = sample_scene();
  scene.output.vtk = scene.output.report = false;
  EXPECT_EQ(write_results({folder.path()}, scene, bed, sample_record(), {}), "");
  EXPECT_EQ(folder.count(), 3) << "bed.h5, poses.csv, summary.json";
}

TEST(Results, WithoutRoomForAllThereIsNoSummary) {
  const TemporaryFolder folder;
  const PackedBed bed = sample_bed(20);
  fs::create_directory(folder / "report.html");  // cannot be replaced by a file
  EXPECT_THROW(write_results({folder.path()}, sample_scene(), bed, sample_record(), sample_analysis(bed)),
               SystemError);
  EXPECT_FALSE(fs::exists(folder / "summary.json"));
}

TEST(Curves, TablesHaveTheirColumnsAndLeaveOutWhatIsNotThere) {
  const TemporaryFolder folder;
  const PackedBed bed = sample_bed(20);
  write_results({folder.path()}, sample_scene(), bed, sample_record(), sample_analysis(bed));
  const auto first_line = [&](const char* name) {
    const std::string text = read_file(folder / name);
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(first_line("axial.csv"), "height_m,height_dp,packing_density,packing_density_exact,porosity");
  EXPECT_EQ(first_line("radial.csv"),
            "wall_distance_m,wall_distance_dp,packing_density,packing_density_exact,porosity");
  EXPECT_EQ(first_line("planar.csv"), "x_m,y_m,packing_density");
  EXPECT_EQ(first_line("orientation.csv"), "from_deg,to_deg,count,fraction,isotropic");
  EXPECT_EQ(first_line("angles.csv"), "pellet,angle_deg,lambert_x,lambert_y");
  EXPECT_EQ(read_file(folder / "planar.csv").find("nan"), std::string::npos)
      << "outside the container is left out";
}

}  // namespace
}  // namespace packbed
