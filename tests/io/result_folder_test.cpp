// Nothing is overwritten without being asked, and a folder that cannot take the results is refused before the
// run.
#include "io/result_folder.hpp"

#include <gtest/gtest.h>
#include <sys/mount.h>

#include <filesystem>

#include "io/atomic_file.hpp"
#include "io/temporary_folder.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

template <class Error, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

TEST(ResultFolder, IsMadeWithItsParentsAndLeftEmpty) {
  const TemporaryFolder base;
  EXPECT_EQ(new_result_folder(base / "a/b/c", false).file("x.csv"), base / "a/b/c/x.csv");
  EXPECT_TRUE(fs::is_directory(base / "a/b/c"));
  EXPECT_TRUE(fs::is_empty(base / "a/b/c"));
  EXPECT_NO_THROW(new_result_folder(base / "a/b/c", false)) << "an empty folder may be used";
}

TEST(ResultFolder, IsNeverOverwrittenWithoutForce) {
  const TemporaryFolder base;
  write_atomically(base / "bed.h5", "precious");
  const std::string message = message_of<InputError>([&] { new_result_folder(base.path(), false); });
  EXPECT_NE(message.find(base.path()), std::string::npos) << message;
  EXPECT_NE(message.find("--force"), std::string::npos) << message;
  EXPECT_EQ(read_file(base / "bed.h5"), "precious");
}

TEST(ResultFolder, ForceRemovesTheEarlierRunAndNothingElse) {
  const TemporaryFolder base;
  write_atomically(base / "bed.h5", "old");
  write_atomically(base / "axial.csv", "old");
  write_atomically(base / "notes of mine.txt", "keep");
  fs::create_directory(base / "frames");
  write_atomically(base / "frames/frame_000000.vtu", "old");
  new_result_folder(base.path(), true);
  EXPECT_EQ(base.count(), 1);
  EXPECT_EQ(read_file(base / "notes of mine.txt"), "keep");
}

TEST(ResultFolder, AnInterruptedRunIsPointedToResume) {
  const TemporaryFolder base;
  write_atomically(base / "case.toml", "x");
  write_atomically(base / "checkpoint.bin", "x");
  const std::string message = message_of<InputError>([&] { new_result_folder(base.path(), false); });
  EXPECT_NE(message.find("packbed resume " + base.path()), std::string::npos) << message;
}

TEST(ResultFolder, BelowAFileOrInProcIsRefused) {
  const TemporaryFolder base;
  write_atomically(base / "file", "x");
  EXPECT_NE(message_of<InputError>([&] { new_result_folder(base / "file", true); }).find("file"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { new_result_folder(base / "file/out", true); }).find("file/out"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { new_result_folder("/proc/packbed", false); }).find("/proc/packbed"),
            std::string::npos);
}

TEST(ResultFolder, MoreThanTheDiskHasIsRefusedBeforeTheRun) {
  const TemporaryFolder base;
  const std::string message =
      message_of<SystemError>([&] { new_result_folder(base / "out", false, 1LL << 60); });
  EXPECT_NE(message.find("free"), std::string::npos) << message;
}

/// A disk of 256 kB, where the tests may mount one.
struct SmallDisk {
  explicit SmallDisk(const std::string& p)
      : path(p), mounted(::mount("tmpfs", p.c_str(), "tmpfs", 0, "size=256k") == 0) {}
  ~SmallDisk() {
    if (mounted) ::umount(path.c_str());
  }
  std::string path;
  bool mounted;
};

TEST(ResultFolder, AFullDiskIsNamedWithTheFileAndNothingHalfWrittenStays) {
  const TemporaryFolder base;
  const SmallDisk disk(base.path());
  if (!disk.mounted) GTEST_SKIP() << "mounting is not allowed here";
  const ResultFolder folder = new_result_folder(base / "out", false, 0);
  const std::string message =
      message_of<SystemError>([&] { write_atomically(folder.file("bed.h5"), std::string(1 << 20, 'x')); });
  EXPECT_NE(message.find("bed.h5"), std::string::npos) << message;
  EXPECT_NE(message.find("No space left"), std::string::npos) << message;
  EXPECT_TRUE(fs::is_empty(folder.path));
}

TEST(ResultFolder, ResumeNeedsACaseAndClearsWhatAKillLeftBehind) {
  const TemporaryFolder base;
  EXPECT_THROW(interrupted_result_folder(base / "none"), InputError);
  EXPECT_THROW(interrupted_result_folder(base.path()), InputError);
  write_atomically(base / "case.toml", "x");
  write_atomically(base / "bed.h5.123.tmp", "half");
  EXPECT_EQ(interrupted_result_folder(base.path()).path, base.path());
  EXPECT_EQ(base.count(), 1);
}

TEST(ResultFolder, TwoRunsNeverShareOne) {
  const TemporaryFolder base;
  {
    const ResultFolder first = new_result_folder(base.path(), true);
    write_atomically(first.file("case.toml"), "x");
    const std::string message = message_of<InputError>([&] { interrupted_result_folder(base.path()); });
    EXPECT_NE(message.find("another packbed"), std::string::npos) << message;
    EXPECT_THROW(new_result_folder(base.path(), true), InputError);
    EXPECT_EQ(read_file(base / "case.toml"), "x") << "--force removes nothing that a run is using";
  }
  EXPECT_NO_THROW(interrupted_result_folder(base.path())) << "the first run has ended";
}

TEST(ResultFolder, AFileOrItsFolderNamesTheFile) {
  const TemporaryFolder base;
  write_atomically(base / "bed.h5", "x");
  EXPECT_EQ(file_in(base.path(), "bed.h5"), base / "bed.h5");
  EXPECT_EQ(file_in(base / "bed.h5", "bed.h5"), base / "bed.h5");
  EXPECT_THROW(file_in(base.path(), "voxels.h5"), InputError);
  EXPECT_THROW(file_in(base / "nothing", "bed.h5"), InputError);
}

}  // namespace
}  // namespace packbed
