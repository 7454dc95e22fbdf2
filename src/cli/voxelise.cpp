// packbed voxelise: bed to grid.
#include "bed/voxelise.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <thread>

#include "analysis/layout.hpp"
#include "cli/commands.hpp"
#include "io/bed.hpp"
#include "io/grid.hpp"
#include "io/result_folder.hpp"
#include "math/quantity.hpp"
#include "math/threads.hpp"

namespace packbed::cli {
namespace {

std::string beside(const std::string& bed) {
  const std::filesystem::path path(bed);
  const std::filesystem::path folder = std::filesystem::is_directory(path) ? path : path.parent_path();
  return (folder / result_file::kVoxels).string();
}

}  // namespace

int voxelise(const VoxeliseOptions& options) {
  set_threads(options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency()));
  const double pitch = parse_quantity(options.pitch, Dimension::length, "--pitch");
  const PackedBed bed = read_bed(options.bed);
  const VoxelGrid grid = packbed::voxelise(bed, frame_for(bed, pitch), options.labels);
  const bool round = bed.container.kind == ContainerKind::tube || bed.container.kind == ContainerKind::mesh;
  const std::string out = options.out.empty() ? beside(options.bed) : options.out;
  write_grid(out, grid, {round ? bed.container.radius : 0, pellet_diameter(bed, {}), "bed " + bed_hash(bed)});
  fmt::print("{} x {} x {} voxels of {}, {} pellets: {}\n", grid.frame.size[0], grid.frame.size[1],
             grid.frame.size[2], format_quantity(pitch, Dimension::length), bed.pellets.size(), out);
  return 0;
}

}  // namespace packbed::cli
