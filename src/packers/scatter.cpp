#include "packers/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace packbed {
namespace {

/// Spheres of one factor of two in size, in cells as wide as the largest of them.
class Level {
 public:
  explicit Level(double largest) : width_(2 * largest), largest_(largest) {}

  double largest() const { return largest_; }
  void add(const Vec3& x, double radius) { cells_[key(cell(x))].push_back({x, radius}); }
  bool overlaps(const Vec3& x, double radius) const {
    const Eigen::Vector3i low = cell(x - Vec3::Constant(radius + largest_)),
                          high = cell(x + Vec3::Constant(radius + largest_));
    for (int k = low.z(); k <= high.z(); ++k)
      for (int j = low.y(); j <= high.y(); ++j)
        for (int i = low.x(); i <= high.x(); ++i) {
          const auto found = cells_.find(key({i, j, k}));
          if (found == cells_.end()) continue;
          for (const Ball& b : found->second)
            if ((b.centre - x).squaredNorm() < (b.radius + radius) * (b.radius + radius)) return true;
        }
    return false;
  }

 private:
  struct Ball {
    Vec3 centre;
    double radius;
  };
  Eigen::Vector3i cell(const Vec3& x) const { return (x / width_).array().floor().cast<int>(); }
  static std::uint64_t key(const Eigen::Vector3i& c) {
    const auto bits = [&](int k) { return static_cast<std::uint64_t>(c[k] + (1 << 20)) & 0x1fffff; };
    return bits(0) | bits(1) << 21 | bits(2) << 42;
  }

  double width_, largest_;
  std::unordered_map<std::uint64_t, std::vector<Ball>> cells_;
};

}  // namespace

std::vector<Vec3> scattered(std::span<const double> radii, int tries,
                            const std::function<std::optional<Vec3>(std::size_t, int)>& draw) {
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return radii[a] > radii[b]; });
  std::vector<Vec3> places(radii.size());
  std::vector<Level> levels;
  for (const std::size_t i : order) {
    if (levels.empty() || radii[i] < 0.5 * levels.back().largest()) levels.emplace_back(radii[i]);
    const auto hits = [&](const Vec3& x) {
      return std::any_of(levels.begin(), levels.end(),
                         [&](const Level& level) { return level.overlaps(x, radii[i]); });
    };
    std::optional<Vec3> place;
    for (int t = 0; t < tries && !place; ++t) {
      place = draw(i, t);
      if (place && hits(*place)) place.reset();
    }
    if (!place) return {};
    levels.back().add(*place, radii[i]);
    places[i] = *place;
  }
  return places;
}

}  // namespace packbed
