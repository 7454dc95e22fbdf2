#include "lattice/probes.hpp"

namespace packbed {
namespace {

struct Ring {
  double radius, height;
  int count;
  bool in_bore = false;
};
// rims first, which go farthest in a rotation
constexpr Ring kRings[] = {{1, 1, 28},  {1, -1, 28},  {1, 0, 12},       {1, 0.5, 12},    {1, -0.5, 12},
                           {0.6, 1, 9}, {0.6, -1, 9}, {1, 1, 12, true}, {1, 0, 9, true}, {1, -1, 12, true}};

}  // namespace

Probes::Probes(const Shape& shape, double pitch)
    : radius_(shape.radius / pitch),
      bore_(shape.inner_radius / pitch),
      half_height_(shape.half_height / pitch) {
  if (shape.kind != ShapeClass::cylinder && shape.kind != ShapeClass::tube) return;
  for (const Ring& ring : kRings) {
    if (ring.in_bore && !(bore_ > 0)) continue;
    for (int k = 0; k < ring.count; ++k) {
      const double phi =
          2 * kPi * (k * 5 % ring.count + 0.5) / ring.count;  // neighbours in the list lie apart
      points_.push_back(
          {Vec3(ring.radius * std::cos(phi), ring.radius * std::sin(phi), ring.height), ring.in_bore});
    }
  }
}

}  // namespace packbed
