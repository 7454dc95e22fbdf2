#include "packers/layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace packbed {
namespace {

constexpr int kOffsets = 12;         // tried along each side of the lattice's cell
constexpr double kManyPitches = 25;  // beyond this reach the offset no longer matters
constexpr double kRoom = 1 + 1e-9;

/// Lattice points of unit pitch about `offset`, nearest first, within `reach`.
std::vector<Vec2> lattice(const Vec2& offset, double reach) {
  const int n = static_cast<int>(std::ceil(reach * 1.2)) + 2;
  std::vector<Vec2> points;
  for (int j = -n; j <= n; ++j)
    for (int i = -2 * n; i <= 2 * n; ++i) {
      const Vec2 p = Vec2(i + 0.5 * j, j * std::sqrt(0.75)) - offset;
      if (p.norm() <= reach) points.push_back(p);
    }
  std::stable_sort(points.begin(), points.end(),
                   [](const Vec2& a, const Vec2& b) { return a.squaredNorm() < b.squaredNorm(); });
  return points;
}

}  // namespace

LayerPattern layer_pattern(double radius, double spacing, int wanted, bool loose) {
  spacing *= kRoom;
  const std::size_t count = static_cast<std::size_t>(std::max(1, wanted));
  const double dense_reach = radius / spacing;  // in pitches
  // a circle of 1.1 sqrt(n) + 2 pitches holds n points of any hexagonal lattice of unit pitch (0.866 each)
  const double loose_reach = std::min(dense_reach, 1.1 * std::sqrt(static_cast<double>(count)) + 2);
  std::vector<Vec2> best;
  double best_distance = std::numeric_limits<double>::infinity();
  const double reach = loose ? loose_reach : dense_reach;
  const int offsets = reach > kManyPitches ? 1 : kOffsets;
  for (int j = 0; j < offsets; ++j)
    for (int i = 0; i < offsets; ++i) {
      const Vec2 offset = Vec2(i + 0.5 * j, j * std::sqrt(0.75)) / kOffsets;
      std::vector<Vec2> points = lattice(offset, reach);
      if (loose && points.size() > count) points.resize(count);
      const double distance = points.empty() ? 0.0 : points.back().norm();
      if (points.size() > best.size() || (points.size() == best.size() && distance < best_distance - 1e-12)) {
        best = std::move(points);
        best_distance = distance;
      }
    }
  LayerPattern pattern;
  pattern.pitch = spacing;
  if (loose && best.size() == count) {
    const double room = best_distance > 0 ? radius / best_distance : std::numeric_limits<double>::infinity();
    pattern.pitch = std::clamp(room, spacing, 2 * radius + spacing);
  }
  pattern.shake = 0.5 * (pattern.pitch - spacing);
  for (const Vec2& p : best) pattern.sites.push_back(p * pattern.pitch);
  return pattern;
}

std::vector<Vec2> shaken(const LayerPattern& pattern, double radius, Random& random) {
  std::vector<Vec2> sites = pattern.sites;
  const Eigen::Rotation2Dd turn(random.uniform(0, 2 * kPi));
  shuffle(sites, random);
  for (Vec2& site : sites) {
    site = turn * site;
    const double angle = random.uniform(0, 2 * kPi), r = pattern.shake * std::sqrt(random.uniform());
    const Vec2 moved = site + r * Vec2(std::cos(angle), std::sin(angle));
    if (moved.norm() <= radius) site = moved;
  }
  return sites;
}

}  // namespace packbed
