#pragma once
// Which bodies may touch before the next search: sorted cells over bounding spheres, each grown by the way
// that its body may go.
#include <cstdint>
#include <span>
#include <vector>

#include "math/types.hpp"

namespace packbed {

struct BodyPair {
  std::uint32_t a = 0, b = 0;  // a < b
  bool operator==(const BodyPair&) const = default;
  bool operator<(const BodyPair& o) const { return a != o.a ? a < o.a : b < o.b; }
};

/// All pairs of `bodies` (indices) with |x_a - x_b| < reach_a + reach_b, ascending; pairs of two `still`
/// bodies are left out. reach: bounding radius plus margin [m]. Work space is kept between calls.
class NeighbourSearch {
 public:
  void find(std::span<const std::uint32_t> bodies, const std::vector<Vec3>& position,
            const std::vector<double>& reach, const std::vector<std::uint8_t>& still,
            std::vector<BodyPair>& pairs);

 private:
  std::vector<std::uint32_t> cell_of_, start_, sorted_;
  std::vector<Vec3> place_;
  std::vector<std::vector<BodyPair>> found_;
};

/// The same by trying every pair: the oracle.
void find_pairs_brute_force(std::span<const std::uint32_t> bodies, const std::vector<Vec3>& position,
                            const std::vector<double>& reach, const std::vector<std::uint8_t>& still,
                            std::vector<BodyPair>& pairs);

}  // namespace packbed
