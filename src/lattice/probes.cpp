#include "lattice/probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/simd.hpp"
#include "mesh/topology.hpp"

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

/// Of meshes: how many places, and how far from the surface they are brought in [cells].
constexpr std::size_t kPlaces = 1200;
constexpr double kDeeper = 0.35;
/// Cells of the core along one of the lattice, and how many of them away it is looked for from the surface.
constexpr double kFiner = 4;
constexpr int kReach = 6;

/// Places on a surface no farther than `step` from each other, on edges and corners too.
std::vector<Vec3> places_on(const TriangleMesh& surface, double step) {
  std::vector<Vec3> places;
  for (const auto& t : surface.triangles) {
    const Vec3 &a = corner(surface, t, 0), &b = corner(surface, t, 1), &c = corner(surface, t, 2);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int n = std::max(1, static_cast<int>(std::ceil(longest / step)));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) places.push_back(a + (i * (b - a) + j * (c - a)) / n);
  }
  return places;
}

/// So many of them, the farthest from the origin first, then each the farthest from all before it.
std::vector<Vec3> spread(const std::vector<Vec3>& places, std::size_t count) {
  std::vector<Vec3> chosen;
  std::vector<double> away(places.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].squaredNorm() > places[next].squaredNorm()) next = i;
  while (chosen.size() < std::min(count, places.size())) {
    chosen.push_back(places[next]);
    for (std::size_t i = 0; i < places.size(); ++i)
      away[i] = std::min(away[i], (places[i] - chosen.back()).squaredNorm());
    next = static_cast<std::size_t>(std::max_element(away.begin(), away.end()) - away.begin());
  }
  return chosen;
}

}  // namespace

Probes::Probes(const Shape& shape, double pitch)
    : radius_(shape.radius / pitch),
      bore_(shape.inner_radius / pitch),
      half_height_(shape.half_height / pitch) {
  if (shape.kind == ShapeClass::cylinder || shape.kind == ShapeClass::tube) add_rings();
  if (shape.kind == ShapeClass::mesh || shape.kind == ShapeClass::convex) add_places(shape, pitch);
}

/// The n-th place; the last one fills the last eight.
void Probes::add(std::size_t n, const Vec3& grown, const Vec3& fixed) {
  if (n % kLane == 0) eights_.emplace_back();
  for (int d = 0; d < 3; ++d)
    for (std::size_t l = n % kLane; l < kLane; ++l) {
      eights_.back().grown[d][l] = grown[d];
      eights_.back().fixed[d][l] = fixed[d];
    }
}

void Probes::add_rings() {
  std::size_t n = 0;
  for (const Ring& ring : kRings) {
    if (ring.in_bore && !(bore_ > 0)) continue;
    const double radius = ring.in_bore ? bore_ : radius_, inset = ring.in_bore ? kInset : -kInset;
    for (int k = 0; k < ring.count; ++k) {
      // neighbours in the list lie apart
      const double phi = 2 * kPi * (k * 5 % ring.count + 0.5) / ring.count;
      const Vec3 place(ring.radius * std::cos(phi), ring.radius * std::sin(phi), ring.height);
      add(n++, place.cwiseProduct(Vec3(radius, radius, half_height_)),
          place.cwiseProduct(Vec3(inset, inset, -kInset)));
    }
  }
}

void Probes::add_places(const Shape& shape, double pitch) {
  core_.emplace(shape.surface, shape.bounding_radius, pitch / kFiner);
  std::size_t n = 0;
  for (const Vec3& place : spread(places_on(shape.surface, shape.bounding_radius / 16), kPlaces)) {
    const Vec3 in = core_->inwards(kFiner / pitch * place, kReach);
    if (in.squaredNorm() > 0) add(n++, place / pitch, kDeeper * in);
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
  p.per_cell = kFiner / scale;
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

void Probes::ask_core(const Placed& p, Cells& cells) const {
  for (std::size_t l = 0; l < kLane; ++l) {
    const double x = cells.x[l] - p.phase[0], y = cells.y[l] - p.phase[1], z = cells.z[l] - p.phase[2];
    double own[3];
    for (int d = 0; d < 3; ++d)
      own[d] = p.per_cell * (p.turn[0][d] * x + p.turn[1][d] * y + p.turn[2][d] * z);
    cells.solid[l] = core_->holds(own[0], own[1], own[2]);
  }
}

}  // namespace packbed
