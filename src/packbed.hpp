#pragma once
// The public library: shapes and containers in, a bed out, its voxels and its analysis. In CMake:
//   find_package(packbed REQUIRED)   target_link_libraries(mine PRIVATE packbed::packbed)
// Everything is SI: metres, kilograms, seconds, radians; z is up and the floor of the bed is at z = 0.
#include "analysis/analyse.hpp"
#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"
#include "bed/scene.hpp"
#include "bed/voxelise.hpp"
#include "contact/damping.hpp"
#include "io/cad.hpp"
#include "io/case.hpp"
#include "lattice/count.hpp"
#include "lattice/voxel_grid.hpp"
#include "math/error.hpp"
#include "math/random.hpp"
#include "math/threads.hpp"
#include "math/types.hpp"
#include "mesh/check.hpp"
#include "mesh/mesh.hpp"
#include "packers/packer.hpp"
#include "shape/container.hpp"
#include "shape/shape.hpp"
