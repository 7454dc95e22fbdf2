#pragma once
// Counter-based random numbers (Philox4x32-10; Salmon, Moraes, Dror & Shaw, SC 2011): the value depends only
// on (seed, stream, counter), so no order of evaluation and no number of threads can change it.
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "math/types.hpp"

namespace packbed {

/// Ten rounds of Philox on a 128-bit counter with a 64-bit key.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

/// Uses of randomness, so that two of them never share numbers.
enum class Stream : std::uint32_t {
  feed_position = 1,
  feed_rotation,
  feed_velocity,
  feed_shape,
  lattice_move,
  test,
  feed_size
};

/// The numbers of one event of one body: Random(seed, stream, body, event) then draw in order.
class Random {
 public:
  Random(std::uint64_t seed, Stream stream, std::uint32_t body, std::uint32_t event = 0);
  std::uint32_t bits();  ///< 32 uniform bits
  double uniform();      ///< in [0, 1), 53 bits
  double uniform(double low, double high);
  double normal();   ///< mean 0, standard deviation 1
  Vec3 on_sphere();  ///< uniform direction
  Quat rotation();   ///< uniform on SO(3) (Shoemake, Graphics Gems III, 1992)

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
};

/// Every order equally likely (Fisher & Yates).
template <class T>
void shuffle(std::vector<T>& items, Random& random) {
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
}

}  // namespace packbed
