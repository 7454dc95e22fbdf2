#include "dynamics/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/threads.hpp"

namespace packbed {
namespace {

bool near(const Vec3& a, const Vec3& b, double reach) {
  return (a - b).squaredNorm() < reach * reach;
}

BodyPair ordered(std::uint32_t a, std::uint32_t b) {
  return a < b ? BodyPair{a, b} : BodyPair{b, a};
}

}  // namespace

void NeighbourSearch::find(std::span<const std::uint32_t> bodies, const std::vector<Vec3>& position,
                           const std::vector<double>& reach, const std::vector<std::uint8_t>& still,
                           std::vector<BodyPair>& pairs) {
  pairs.clear();
  const std::size_t n = bodies.size();
  if (n < 2) return;
  Box3 box;
  double largest = 0;
  for (std::uint32_t i : bodies) {
    box.extend(position[i]);
    largest = std::max(largest, reach[i]);
  }
  // cells as wide as the largest pair can reach, but never more than some four cells a body
  double width = 2.0 * largest;
  const Vec3 extent = box.sizes();
  const double room = extent.x() * extent.y() * extent.z();
  width = std::max(width, std::cbrt(room / (4.0 * static_cast<double>(n))));
  std::array<std::int64_t, 3> size;
  for (int k = 0; k < 3; ++k) {
    const double cells = std::min(extent[k] / width, 4096.0);
    size[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(cells) + 1;
  }
  const auto cell_at = [&](const Vec3& x, int k) {
    const auto c = static_cast<std::int64_t>((x[k] - box.min()[k]) / width);
    return std::clamp<std::int64_t>(c, 0, size[static_cast<std::size_t>(k)] - 1);
  };
  const std::size_t cells = static_cast<std::size_t>(size[0] * size[1] * size[2]);
  cell_of_.resize(n);
  start_.assign(cells + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& x = position[bodies[i]];
    cell_of_[i] =
        static_cast<std::uint32_t>((cell_at(x, 2) * size[1] + cell_at(x, 1)) * size[0] + cell_at(x, 0));
    ++start_[cell_of_[i] + 1];
  }
  for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
  sorted_.resize(n);
  place_.resize(n);
  {
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t slot = next[cell_of_[i]]++;
      sorted_[slot] = bodies[i];
      place_[slot] = position[bodies[i]];
    }
  }
  // each layer of cells gathers its own pairs: with itself and the half of the neighbours that come later
  const std::size_t layers = static_cast<std::size_t>(size[2]);
  found_.resize(layers);
  parallel_for(layers, 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t layer = from; layer < to; ++layer) {
      std::vector<BodyPair>& out = found_[layer];
      out.clear();
      const auto z = static_cast<std::int64_t>(layer);
      for (std::int64_t y = 0; y < size[1]; ++y)
        for (std::int64_t x = 0; x < size[0]; ++x) {
          const auto cell = static_cast<std::size_t>((z * size[1] + y) * size[0] + x);
          for (std::uint32_t i = start_[cell]; i < start_[cell + 1]; ++i) {
            const std::uint32_t a = sorted_[i];
            const auto look = [&](std::uint32_t begin, std::uint32_t end) {
              for (std::uint32_t j = begin; j < end; ++j) {
                const std::uint32_t b = sorted_[j];
                if (near(place_[i], place_[j], reach[a] + reach[b]) && !(still[a] && still[b]))
                  out.push_back(ordered(a, b));
              }
            };
            look(i + 1, start_[cell + 1]);
            if (x + 1 < size[0]) look(start_[cell + 1], start_[cell + 2]);
            const auto look_at_row = [&](std::int64_t row_y,
                                         std::int64_t row_z) {  // three cells side by side
              if (row_y < 0 || row_y >= size[1] || row_z >= size[2]) return;
              const auto row = static_cast<std::size_t>((row_z * size[1] + row_y) * size[0]);
              look(start_[row + static_cast<std::size_t>(std::max<std::int64_t>(0, x - 1))],
                   start_[row + static_cast<std::size_t>(std::min(size[0] - 1, x + 1)) + 1]);
            };
            look_at_row(y + 1, z);
            for (std::int64_t dy = -1; dy <= 1; ++dy) look_at_row(y + dy, z + 1);
          }
        }
    }
  });
  for (const std::vector<BodyPair>& layer : found_) pairs.insert(pairs.end(), layer.begin(), layer.end());
  std::sort(pairs.begin(), pairs.end());
}

void find_pairs_brute_force(std::span<const std::uint32_t> bodies, const std::vector<Vec3>& position,
                            const std::vector<double>& reach, const std::vector<std::uint8_t>& still,
                            std::vector<BodyPair>& pairs) {
  pairs.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const std::uint32_t a = bodies[i], b = bodies[j];
      if (near(position[a], position[b], reach[a] + reach[b]) && !(still[a] && still[b]))
        pairs.push_back(ordered(a, b));
    }
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace packbed
