// packbed handover: a lattice bed is polished by the mesh packer, a mesh bed is put on a lattice.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "io/temporary_folder.hpp"

namespace packbed {
namespace {

int packbed(const std::string& arguments) {
  return std::system(
      ("'" PACKBED_PROGRAM "' " + arguments + " --threads 1 --quiet > /dev/null 2>&1").c_str());
}

nlohmann::json summary(const std::string& folder) {
  return nlohmann::json::parse(std::ifstream(folder + "/summary.json"));
}

TEST(Handover, PolishesALatticeBedAndPutsItBack) {
  const TemporaryFolder folder;
  const std::string lattice = folder / "lattice", polished = folder / "polished", back = folder / "back";
  const std::string small =
      " --set feed.count=50 --set container.inner_diameter=20mm"
      " --set container.shape=tube --set container.height=60mm --set feed.drop_height=50mm"
      " --set feed.per_layer=6 --set feed.kind=pour --set analysis.exact=false"
      " --set lattice.voxel=0.3mm --set output.report=false --set output.vtk=false";
  ASSERT_EQ(
      packbed("run " PACKBED_SOURCE_DIR "/cases/quick.toml --set method=digidem --out " + lattice + small),
      0);
  const double before = summary(lattice)["overlap"]["rest_mean"];
  EXPECT_GT(before, 0.01);  // bodies of a lattice overlap by part of a cell

  EXPECT_EQ(packbed("handover " + lattice + " --to mesh --out " + polished), 0);
  const nlohmann::json mesh = summary(polished + "/mesh");
  EXPECT_EQ(mesh["audit"], "passed");
  EXPECT_EQ(mesh["pellets"]["inside"], 50);
  EXPECT_LT(mesh["overlap"]["rest_mean"].get<double>(), 0.1 * before);

  EXPECT_EQ(packbed("handover " + polished + "/mesh --to digidem --out " + back), 0);
  EXPECT_EQ(summary(back + "/digidem")["audit"], "passed");
  EXPECT_NEAR(summary(back + "/digidem")["bed"]["packing_density"].get<double>(),
              mesh["bed"]["packing_density"].get<double>(), 0.02);
}

}  // namespace
}  // namespace packbed
