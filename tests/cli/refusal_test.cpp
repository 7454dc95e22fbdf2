// A case that is read but cannot be packed: exit 2, nothing half-written, nothing lost.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cli/program.hpp"
#include "io/temporary_folder.hpp"

namespace packbed {
namespace {

class Refused : public testing::TestWithParam<const char*> {};

TEST_P(Refused, RunLeavesNoFolderAndKeepsEarlierResults) {
  const TemporaryFolder folder;
  const std::string words =
      std::string("run '" PACKBED_SOURCE_DIR "/cases/quick.toml' --quiet --set method=") + GetParam() +
      " --set pellet.shape=" + (std::string(GetParam()) == "spheres" ? "sphere" : "cylinder") +
      " --set pellet.diameter=3mm" +
      (std::string(GetParam()) == "spheres" ? "" : " --set pellet.height=3mm") +
      " --set stepping.step=1ms --out '" + (folder / "out") + "'";
  const Ran first = run_program(words);
  EXPECT_EQ(first.code, 2) << first.output;
  EXPECT_NE(first.output.find("stepping.step: found"), std::string::npos) << first.output;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));

  std::filesystem::create_directory(folder / "out");
  std::ofstream(folder / "out" + "/summary.json") << "{}";
  EXPECT_EQ(run_program(words + " --force").code, 2);
  EXPECT_TRUE(std::filesystem::exists(folder / "out" + "/summary.json"));
}

INSTANTIATE_TEST_SUITE_P(By, Refused, testing::Values("mesh", "spheres", "digidem"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace packbed
