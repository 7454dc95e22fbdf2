// packbed check: exit codes and what is said where.
#include <gtest/gtest.h>

#include <string>

#include "command.hpp"

namespace packbed {
namespace {

Ran check(const std::string& arguments) {
  return run_program("check " + arguments);
}

const std::string kMeshes = PACKBED_SOURCE_DIR "/meshes/";

TEST(Check, GoodFileExitsZero) {
  const Ran ran = check(kMeshes + "a38.step");
  EXPECT_EQ(ran.code, 0);
  EXPECT_NE(ran.output.find("cylinder of diameter 3.42 mm and height 3.46 mm"), std::string::npos)
      << ran.output;
}

TEST(Check, ContainerIsReadAsOne) {
  const Ran ran = check(kMeshes + "lc.stl --unit mm --container");
  EXPECT_EQ(ran.code, 0);
  EXPECT_NE(ran.output.find("tube of inner diameter 44.5 mm"), std::string::npos) << ran.output;
}

TEST(Check, TetrahedraOnRequest) {
  const Ran ran = check(kMeshes + "a38.msh --unit mm --tets");
  EXPECT_EQ(ran.code, 0);
  EXPECT_NE(ran.output.find("159 of 30.37"), std::string::npos) << ran.output;
}

TEST(Check, UnusableFilesExitTwo) {
  EXPECT_EQ(check("/nowhere.step").code, 2);
  EXPECT_EQ(check(kMeshes + "a38.stl").code, 2);             // no unit
  EXPECT_EQ(check(kMeshes + "a38.step --unit mm").code, 2);  // a unit too many
  EXPECT_EQ(check(kMeshes + "table.csv").code, 2);           // no CAD
}

}  // namespace
}  // namespace packbed
