// A run on a lattice that is killed (SIGKILL) after its first checkpoint is resumed to the bed of a run that
// was not.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/temporary_folder.hpp"

namespace packbed {
namespace {

pid_t start(std::vector<std::string> words) {
  words.insert(words.begin(), PACKBED_PROGRAM);
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  const int nothing = open("/dev/null", O_WRONLY);
  dup2(nothing, 1);
  dup2(nothing, 2);
  execv(argv[0], argv.data());
  _exit(127);
}

int status_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

std::string hash_of(const std::string& folder) {
  return nlohmann::json::parse(std::ifstream(folder + "/summary.json")).at("bed_hash");
}

class Killed : public testing::TestWithParam<const char*> {};

TEST_P(Killed, IsResumedToTheSameBed) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& out) {
    std::vector<std::string> words{
        "run", PACKBED_SOURCE_DIR "/cases/quick.toml", "--quiet", "--threads", "1", "--out", out};
    for (const char* set : {"pellet.shape=cylinder", "pellet.diameter=3.42mm", "pellet.height=3.46mm",
                            "feed.kind=pour", "feed.count=60", "feed.per_layer=6", "feed.drop_height=50mm",
                            "container.shape=tube", "container.inner_diameter=20mm", "container.height=60mm",
                            "lattice.voxel=0.3mm", "analysis.exact=false", "output.report=false",
                            "output.vtk=false", "output.checkpoint_interval=20ms"})
      words.insert(words.end(), {"--set", set});
    words.insert(words.end(), {"--set", std::string("method=") + GetParam()});
    return start(words);
  };
  const std::string whole = folder / "whole", cut = folder / "cut";
  ASSERT_EQ(WEXITSTATUS(status_of(run(whole))), 0);
  const pid_t child = run(cut);
  while (!std::filesystem::exists(cut + "/checkpoint.bin") && waitpid(child, nullptr, WNOHANG) == 0)
    usleep(1000);
  kill(child, SIGKILL);
  ASSERT_TRUE(WIFSIGNALED(status_of(child)));  // there was something left to do
  ASSERT_FALSE(std::filesystem::exists(cut + "/summary.json"));
  ASSERT_EQ(WEXITSTATUS(status_of(start({"resume", cut, "--quiet", "--threads", "2"}))), 0);
  EXPECT_EQ(hash_of(cut), hash_of(whole));
}

INSTANTIATE_TEST_SUITE_P(Methods, Killed, testing::Values("digipac", "digicgp", "digidem"));

}  // namespace
}  // namespace packbed
