#pragma once
// The folder that a run leaves behind, and the names of what is in it (docs/results.md).
#include <memory>
#include <string>
#include <string_view>

namespace packbed {

namespace result_file {
inline constexpr std::string_view kSummary = "summary.json", kBed = "bed.h5", kBedVtu = "bed.vtu",
                                  kContainerVtu = "container.vtu", kPoses = "poses.csv",
                                  kContacts = "contacts.csv", kAxial = "axial.csv", kRadial = "radial.csv",
                                  kPlanar = "planar.csv", kOrientation = "orientation.csv",
                                  kAngles = "angles.csv", kSizes = "sizes.csv",
                                  kCoordination = "coordination.csv", kReport = "report.html",
                                  kVoxels = "voxels.h5", kCase = "case.toml", kCheckpoint = "checkpoint.bin",
                                  kTrajectory = "trajectory.h5", kTrajectoryCsv = "trajectory.csv",
                                  kTrajectorySeries = "trajectory.pvd", kTrajectoryLog = "trajectory.part",
                                  kFrames = "frames";
}  // namespace result_file

struct ResultFolder {
  std::string path;
  std::shared_ptr<void> lock =
      nullptr;  // of a folder that a run writes to: no second run may, until it ends or dies

  std::string file(std::string_view name) const;
  bool has(std::string_view name) const;
};

/// Throws InputError when the folder is there and cannot be read, or is not empty, unless `force`: asked
/// before anything is set up.
void require_new_folder(const std::string& path, bool force);

/// A folder for a new run, made with its parents; proves that it can be written by writing a probe, before
/// hours of work go into it. `bytes_needed`: what the run will write at least [byte]. Throws InputError when
/// it exists and is not empty, unless `force`: then the files of the earlier run (and only those that packbed
/// writes) are removed. Throws InputError when the path is no folder or cannot be made or written,
/// SystemError when the disk has no room.
ResultFolder new_result_folder(const std::string& path, bool force, long long bytes_needed = 1 << 20);

/// The folder of an interrupted run; removes temporary files that a kill left behind. Throws InputError when
/// it holds no case.toml, cannot be written or the run is still going on, and tells what to do.
ResultFolder interrupted_result_folder(const std::string& path);

/// The file itself, or the file `name` of the result folder that `path` names. Throws InputError when there
/// is none.
std::string file_in(const std::string& path, std::string_view name);

}  // namespace packbed
