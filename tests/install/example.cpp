// The public library in a few lines: where uniformly random directions and rotations fall.
#include <packbed/packbed.hpp>

#include <cstdio>

int main() {
  packbed::set_threads(2);
  packbed::Random random(1, packbed::Stream::test, 0);
  packbed::Vec3 mean = packbed::Vec3::Zero();
  for (int i = 0; i < 10000; ++i) mean += random.rotation() * packbed::Vec3::UnitZ() / 10000;
  std::printf("mean axis of 10000 random rotations: %.4f\n", mean.norm());
  return mean.norm() < 0.05 ? 0 : 1;
}
