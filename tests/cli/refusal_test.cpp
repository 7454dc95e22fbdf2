// A case that is read but cannot be packed: exit 2, nothing half-written, nothing lost.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "command.hpp"
#include "io/temporary_folder.hpp"

namespace packbed {
namespace {

class Refused : public testing::TestWithParam<const char*> {};

TEST_P(Refused, RunLeavesNoFolderAndKeepsEarlierResults) {
  const TemporaryFolder folder;
  const std::string method = GetParam(), out = folder / "out";
  const std::string pellet = method == "spheres" ? "sphere" : "cylinder --set pellet.height=3mm";
  const std::string words = "run '" PACKBED_SOURCE_DIR "/cases/quick.toml' --quiet --set method=" + method +
                            " --set pellet.diameter=3mm --set pellet.shape=" + pellet +
                            " --set stepping.step=1ms --out '" + out + "'";
  const Ran first = run_program(words);
  EXPECT_EQ(first.code, 2) << first.output;
  EXPECT_NE(first.output.find("stepping.step: found"), std::string::npos) << first.output;
  EXPECT_FALSE(std::filesystem::exists(out));

  std::filesystem::create_directory(out);
  std::ofstream(out + "/summary.json") << "{}";
  EXPECT_EQ(run_program(words + " --force").code, 2);
  EXPECT_TRUE(std::filesystem::exists(out + "/summary.json"));
}

INSTANTIATE_TEST_SUITE_P(By, Refused, testing::Values("mesh", "spheres", "digidem"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace packbed
