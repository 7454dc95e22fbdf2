#pragma once
// Random pairs of pellets, brought together to a given depth.
#include <vector>

#include "bench/contact_kernels.hpp"
#include "bench/contact_reference.hpp"

namespace packbed::bench {

struct PosePair {
  Pose a, b;
  double depth = 0;                       // [m]
  std::optional<PressureTouch> pressure;  // of convex bodies
};

/// Depths from 0.1 to 5 % of the size, even in their logarithm. Of convex bodies by a search over directions
/// that shares nothing with the kernels; of others by the law of the last kernel.
std::vector<PosePair> random_pairs(const ContactSubject& subject, int count);

/// Force per depth, at 0.5 % of the size, of touches by flats, edges and corners: largest over smallest.
double stiffness_spread(const ContactSubject& subject, const TouchAt& touch);

}  // namespace packbed::bench
