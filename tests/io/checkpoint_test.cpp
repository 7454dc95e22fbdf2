// A checkpoint gives back the state that it was given, for the same case and version only.
#include "io/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "io/atomic_file.hpp"
#include "io/hdf5_image.hpp"
#include "io/temporary_folder.hpp"
#include "math/error.hpp"
#include "math/random.hpp"

namespace packbed {
namespace {

const std::string kCase = "name = \"x\"\n";

std::vector<std::byte> some_state(std::size_t size) {
  std::vector<std::byte> state(size);
  Random random(1, Stream::test, 1);
  for (std::byte& b : state) b = static_cast<std::byte>(random.bits());
  return state;
}

TEST(Checkpoint, GivesBackTheState) {
  const TemporaryFolder folder;
  for (const std::size_t size : {0u, 1u, 7u, 8u, 100000u}) {
    write_checkpoint(folder / "c", kCase, some_state(size));
    EXPECT_EQ(read_checkpoint(folder / "c", kCase).state, some_state(size));
  }
}

TEST(Checkpoint, OfAnotherCaseIsRefused) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "c", kCase, some_state(100));
  EXPECT_THROW(read_checkpoint(folder / "c", kCase + " "), InputError);
}

TEST(Checkpoint, OfAnotherVersionIsRefused) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "c", kCase, some_state(100));
  EXPECT_EQ(read_checkpoint(folder / "c", kCase).version, PACKBED_VERSION);
  write_atomically(folder / "c", sealed("packbed-checkpoint 9.9.9 " + case_hash(kCase) + "\nstate", "state"));
  EXPECT_THROW(read_checkpoint(folder / "c", kCase), InputError);
}

TEST(Checkpoint, CutOrChangedIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_checkpoint(folder / "none", kCase), InputError);
  write_checkpoint(folder / "c", kCase, some_state(3000));
  const std::string whole = read_file(folder / "c");
  for (std::size_t at = 0; at < whole.size(); at += 61) {
    std::string bad = whole;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    std::ofstream(folder / "c", std::ios::binary) << bad;
    EXPECT_THROW(read_checkpoint(folder / "c", kCase), InputError) << "byte " << at;
    std::ofstream(folder / "c", std::ios::binary) << whole.substr(0, at);
    EXPECT_THROW(read_checkpoint(folder / "c", kCase), InputError) << "cut at " << at;
  }
}

}  // namespace
}  // namespace packbed
