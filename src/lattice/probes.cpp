#include "lattice/probes.hpp"

namespace packbed {

Probes::Probes(const Shape& shape, double pitch)
    : radius_(shape.radius / pitch), half_height_(shape.half_height / pitch) {
  if (shape.kind != ShapeClass::cylinder) return;
  struct Ring {
    double radius, height;
    int count;
  };
  // rims first, which go farthest in a rotation
  constexpr Ring kRings[] = {{1, 1, 28},    {1, -1, 28}, {1, 0, 12},  {1, 0.5, 12},
                             {1, -0.5, 12}, {0.6, 1, 9}, {0.6, -1, 9}};
  for (const Ring& ring : kRings)
    for (int k = 0; k < ring.count; ++k) {
      const double phi =
          2 * kPi * (k * 5 % ring.count + 0.5) / ring.count;  // neighbours in the list lie apart
      points_.emplace_back(ring.radius * std::cos(phi), ring.radius * std::sin(phi), ring.height);
    }
}

}  // namespace packbed
