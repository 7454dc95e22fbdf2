#include "analysis/packing_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace packbed {
namespace {

/// How well spheres fit in the pores of larger ones: 1 when they are much smaller, 0 when they are equal.
double filling(double ratio) {
  return std::pow(1 - ratio, 3.33) + 2.81 * ratio * std::pow(1 - ratio, 2.77);
}
/// How little spheres disturb the smaller ones around them, likewise.
double occupation(double ratio) {
  return std::pow(1 - ratio, 1.97) + 0.36 * ratio * std::pow(1 - ratio, 3.67);
}

}  // namespace

double mixture_porosity(const std::vector<SizeShare>& sizes, double alone) {
  if (sizes.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double by_itself = 1 / (1 - alone);
  double most = 0;
  for (const SizeShare& i : sizes) {
    double room = 0;
    for (const SizeShare& j : sizes)
      room += j.volume * (j.diameter > i.diameter
                              ? by_itself - (by_itself - 1) * occupation(i.diameter / j.diameter)
                              : by_itself * (1 - filling(j.diameter / i.diameter)));
    most = std::max(most, room);
  }
  return 1 - 1 / most;
}

}  // namespace packbed
