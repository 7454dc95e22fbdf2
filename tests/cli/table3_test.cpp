// Cases of the CT paper's table 3, fewer pellets of them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "io/temporary_folder.hpp"

namespace packbed {
namespace {

// Of the many touches of beads whose walls are five cells thick one or the other is always counted anew.
// Where what that changes came in within 25 contact times, however long a touch had lasted, they still moved
// at 0.05 m/s by then.
TEST(LongTable3, BeadsByForcesBetweenVoxelsComeToRestInATaperedTube) {
  const TemporaryFolder folder;
  const std::string run = "'" PACKBED_PROGRAM "' run " PACKBED_SOURCE_DIR
                          "/cases/table3/hb_sc_poured_dem.toml --threads 1 --quiet --out " +
                          (folder / "beads") +
                          " --set feed.count=100 --set stepping.max_time=2s --set output.report=false"
                          " --set output.vtk=false > /dev/null 2>&1";
  EXPECT_EQ(std::system(run.c_str()), 0);  // the audit asks for rest
}

}  // namespace
}  // namespace packbed
