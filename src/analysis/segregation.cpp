#include "analysis/segregation.hpp"

#include <cmath>

namespace packbed {

Segregation segregation(const PackedBed& bed) {
  const double n = static_cast<double>(bed.pellets.size());
  const auto size = [&](const Pellet& p) { return p.scale * bed.shapes[p.shape]->equivalent_diameter(); };
  double mean_size = 0;
  Vec3 mean_place = Vec3::Zero();
  for (const Pellet& p : bed.pellets) {
    mean_size += size(p) / n;
    mean_place += p.pose.position / n;
  }
  double sizes = 0;
  Vec3 places = Vec3::Zero(), both = Vec3::Zero();
  for (const Pellet& p : bed.pellets) {
    const double d = size(p) - mean_size;
    const Vec3 x = p.pose.position - mean_place;
    sizes += d * d;
    places += x.cwiseProduct(x);
    both += d * x;
  }
  Segregation out;
  if (!(std::sqrt(sizes / n) > 1e-9 * mean_size)) return out;  // all alike: there is no correlation
  for (int k = 0; k < 3; ++k)
    if (places[k] > 0) out.along[static_cast<std::size_t>(k)] = both[k] / std::sqrt(sizes * places[k]);
  return out;
}

}  // namespace packbed
