#include "io/result_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>

#include "io/atomic_file.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFiles = {result_file::kSummary,
                               result_file::kBed,
                               result_file::kBedVtu,
                               result_file::kPoses,
                               result_file::kContacts,
                               result_file::kAxial,
                               result_file::kRadial,
                               result_file::kPlanar,
                               result_file::kOrientation,
                               result_file::kAngles,
                               result_file::kSizes,
                               result_file::kCoordination,
                               result_file::kReport,
                               result_file::kVoxels,
                               result_file::kCase,
                               result_file::kCheckpoint,
                               result_file::kTrajectoryCsv,
                               result_file::kTrajectory,
                               result_file::kTrajectorySeries,
                               result_file::kTrajectoryLog,
                               result_file::kContainerVtu,
                               result_file::kFrames};

void remove_temporaries(const std::string& path) {
  for (const fs::directory_entry& entry : fs::directory_iterator(path))
    if (entry.path().extension() == ".tmp") fs::remove_all(entry.path());
}

void remove_earlier_run(const ResultFolder& folder) {
  for (const std::string_view name : kFiles) fs::remove_all(folder.file(name));
  remove_temporaries(folder.path);
}

void prove_writable(const ResultFolder& folder) {
  const std::string probe = folder.file(".probe");
  write_atomically(probe, std::string(1 << 16, 'p'));
  fs::remove(probe);
}

void prove_room(const std::string& path, long long bytes_needed) {
  std::error_code unknown;
  const fs::space_info space = fs::space(path, unknown);
  if (!unknown && space.available < static_cast<std::uintmax_t>(bytes_needed))
    throw SystemError(fmt::format(
        "{}: {:.1f} MB free, the run needs {:.1f} MB. Fix: free space or write elsewhere "
        "(--out)",
        path, static_cast<double>(space.available) / 1e6, static_cast<double>(bytes_needed) / 1e6));
}

/// Held until the last copy goes, or the process does, however it ends. File systems that know no locks give
/// none.
std::shared_ptr<void> lock_of(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return nullptr;
  std::shared_ptr<void> lock(nullptr, [fd](void*) { ::close(fd); });
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw InputError(path, "a folder that another packbed is writing to", "a folder that no run is using",
                     "wait until that run has ended, or give another folder with --out");
  return lock;
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw InputError(path, "a result folder that cannot be made (" + error.message() + ")",
                     "a path in a folder that can be written", "give another one with --out");
  if (!fs::is_directory(path))
    throw InputError(path, "a file", "a folder for the results", "give another path with --out");
}

}  // namespace

std::string ResultFolder::file(std::string_view name) const {
  return (fs::path(path) / name).string();
}

bool ResultFolder::has(std::string_view name) const {
  std::error_code ignored;
  return fs::exists(file(name), ignored);
}

void require_new_folder(const std::string& path, bool force) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return;
  const bool empty = fs::is_empty(path, error);
  if (error)
    throw InputError(path, "a folder that cannot be read (" + error.message() + ")",
                     "a folder that can be written", "give another one with --out");
  if (empty || force) return;
  const ResultFolder folder{path};
  const bool interrupted = folder.has(result_file::kCheckpoint) && !folder.has(result_file::kSummary);
  throw InputError(path, interrupted ? "the folder of an interrupted run" : "a folder that is not empty",
                   "a new or empty folder",
                   interrupted
                       ? "continue it with `packbed resume " + path + "`, or overwrite it with --force"
                       : "give another one with --out, or overwrite it with --force");
}

ResultFolder new_result_folder(const std::string& path, bool force, long long bytes_needed) {
  make_folder(path);
  const ResultFolder folder{path, lock_of(path)};
  require_new_folder(path, force);
  try {
    prove_writable(folder);
    remove_earlier_run(folder);
  } catch (const fs::filesystem_error& e) {
    throw SystemError(fmt::format("{}: {}", path, e.code().message()));
  }
  prove_room(path, bytes_needed);
  return folder;
}

ResultFolder interrupted_result_folder(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error))
    throw InputError(path, "no such folder", "the result folder of an interrupted run");
  const ResultFolder folder{path, lock_of(path)};
  if (!folder.has(result_file::kCase))
    throw InputError(path, "a folder without case.toml", "the result folder of an interrupted run",
                     "start the run anew with `packbed run CASE`");
  try {
    prove_writable(folder);
    remove_temporaries(path);
  } catch (const fs::filesystem_error& e) {
    throw SystemError(fmt::format("{}: {}", path, e.code().message()));
  }
  return folder;
}

std::string file_in(const std::string& path, std::string_view name) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw InputError(path, "no such file or folder", fmt::format("{} or its folder", name));
  if (!fs::is_directory(path, error)) return path;
  const std::string inside = ResultFolder{path}.file(name);
  if (!fs::exists(inside, error))
    throw InputError(path, fmt::format("a folder without {}", name), fmt::format("{} or its folder", name),
                     fs::exists(ResultFolder{path}.file(result_file::kCheckpoint), error)
                         ? "finish the run with `packbed resume " + path + "`"
                         : "");
  return inside;
}

}  // namespace packbed
