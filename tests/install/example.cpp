// The public library in twenty lines: a bed of two pellets, built by hand, becomes voxels.
#include <packbed/packbed.hpp>

#include <cmath>
#include <cstdio>

int main() {
  packbed::PackedBed bed;
  bed.container = packbed::make_tube("tube", 10e-3, 20e-3);
  bed.shapes = {packbed::make_cylinder("a38", 3.42e-3, 3.46e-3), packbed::make_sphere("ball", 1.5e-3)};
  for (std::uint32_t i = 0; i < 2; ++i) {
    packbed::Pellet pellet;
    pellet.id = pellet.shape = i;
    pellet.pose.position = {0, 0, 3e-3 + 5e-3 * i};
    pellet.pose.rotation = packbed::Random(1, packbed::Stream::test, i).rotation();
    bed.pellets.push_back(pellet);
  }
  const packbed::GridFrame frame = packbed::frame_for(bed, 0.05e-3);
  double solid = 0;
  for (const std::int64_t voxels : packbed::slice_counts(packbed::voxelise(bed, frame)))
    solid += static_cast<double>(voxels) * frame.pitch * frame.pitch * frame.pitch;
  const double exact = bed.shapes[0]->volume + bed.shapes[1]->volume;
  std::printf("two pellets: %.3f mm3 of voxels, %.3f mm3 of solid\n", solid * 1e9, exact * 1e9);
  return std::abs(solid / exact - 1) < 2e-3 ? 0 : 1;
}
