#include "lattice/probes.hpp"

#include <cmath>

#include "math/simd.hpp"

namespace packbed {
namespace {

constexpr double kInset = 0.3;  // cells

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
  std::size_t n = 0;
  for (const Ring& ring : kRings) {
    if (ring.in_bore && !(bore_ > 0)) continue;
    for (int k = 0; k < ring.count; ++k, ++n) {
      if (n % kLane == 0) eights_.emplace_back();
      // neighbours in the list lie apart
      const double phi = 2 * kPi * (k * 5 % ring.count + 0.5) / ring.count;
      const double place[] = {ring.radius * std::cos(phi), ring.radius * std::sin(phi), ring.height};
      const double size[] = {ring.in_bore ? bore_ : radius_, ring.in_bore ? bore_ : radius_, half_height_};
      for (std::size_t d = 0; d < 3; ++d)
        for (std::size_t l = n % kLane; l < kLane; ++l) {  // the last one fills the last eight
          eights_.back().grown[d][l] = size[d] * place[d];
          eights_.back().fixed[d][l] = (ring.in_bore && d < 2 ? kInset : -kInset) * place[d];
        }
    }
  }
}

Probes::Placed Probes::place(double scale, const Quat& rotation, const Vec3& phase) const {
  Placed p;
  const Mat3 turn = rotation.toRotationMatrix();
  for (int d = 0; d < 3; ++d) {
    for (int e = 0; e < 3; ++e) p.turn[d][e] = turn(d, e);
    p.phase[d] = phase[d];
  }
  p.scale = scale;
  p.half_height = scale * half_height_;
  p.radius2 = scale * radius_ * scale * radius_;
  p.bore2 = scale * bore_ * scale * bore_;
  return p;
}

PACKBED_WIDE void Probes::find_cells(const Eight& eight, const Placed& p, Cells& cells) {
  for (std::size_t l = 0; l < kLane; ++l) {
    const double x = p.scale * eight.grown[0][l] + eight.fixed[0][l],
                 y = p.scale * eight.grown[1][l] + eight.fixed[1][l],
                 z = p.scale * eight.grown[2][l] + eight.fixed[2][l];
    double along = 0, square = 0;
    std::int32_t cell[3];
    for (int d = 0; d < 3; ++d) {
      const double at = p.phase[d] + (p.turn[d][0] * x + p.turn[d][1] * y + p.turn[d][2] * z);
      cell[d] = static_cast<std::int32_t>(at + (at < 0 ? -0.5 : 0.5));
      const double centre = cell[d] - p.phase[d];
      along += centre * p.turn[d][2];
      square += centre * centre;
    }
    const double across = square - along * along;
    cells.x[l] = cell[0], cells.y[l] = cell[1], cells.z[l] = cell[2];
    cells.solid[l] = static_cast<std::int32_t>(std::abs(along) <= p.half_height) &
                     static_cast<std::int32_t>(across <= p.radius2) &
                     static_cast<std::int32_t>(across >= p.bore2);
  }
}

}  // namespace packbed
