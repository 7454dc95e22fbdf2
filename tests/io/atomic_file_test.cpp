// A file is either whole or not there.
#include "io/atomic_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/temporary_folder.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

TEST(AtomicFile, ReplacesTheOldFileAsAWhole) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.txt";
  write_atomically(path, "old");
  write_atomically(path, [&](const std::string& temporary) {
    std::ofstream(temporary) << "new";
    EXPECT_EQ(read_file(path), "old") << "the old file stays until the new one is whole";
    EXPECT_EQ(fs::path(temporary).parent_path(), fs::path(path).parent_path());
  });
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(folder.count(), 1) << "nothing temporary is left";
}

TEST(AtomicFile, AFailedWriterLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.txt";
  write_atomically(path, "old");
  EXPECT_THROW(write_atomically(path,
                                [](const std::string& temporary) {
                                  std::ofstream(temporary) << "half";
                                  throw std::runtime_error("power cut");
                                }),
               SystemError);
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, NamesPathAndCauseWhenTheFolderIsNoFolder) {
  const TemporaryFolder folder;
  write_atomically(folder / "file", "x");
  try {
    write_atomically(folder / "file/a.txt", "x");
    FAIL() << "written below a regular file";
  } catch (const SystemError& e) {
    EXPECT_NE(std::string(e.what()).find("file/a.txt"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("Not a directory"), std::string::npos) << e.what();
  }
}

TEST(AtomicFile, AFullDiskIsNamed) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.txt";
  try {
    // every write to /dev/full fails like one to a full disk
    write_atomically(path, [](const std::string& temporary) {
      fs::create_symlink("/dev/full", temporary);
      std::ofstream full(temporary);
      full.exceptions(std::ios::badbit | std::ios::failbit);
      full << "content" << std::flush;
    });
    FAIL() << "written to a full disk";
  } catch (const SystemError& e) {
    EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
  }
  EXPECT_EQ(folder.count(), 0);
}

TEST(AtomicFile, ReadingAFolderOrNothingIsAnInputError) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_file(folder / ""), InputError);
  EXPECT_THROW(read_file(folder / "missing"), InputError);
}

}  // namespace
}  // namespace packbed
