#pragma once
// Which spheres of very different sizes may touch: a grid for each factor of two of the reach. A sphere looks
// for partners in the cells of its own level, and up into the levels of larger ones; never down, so a large
// sphere costs no more than a small one (Krijgsman, Ogarko & Luding, Comput. Part. Mech. 1, 2014).
#include <array>
#include <cstdint>
#include <vector>

#include "math/lanes.hpp"

namespace packbed {

class LevelGrid {
 public:
  /// x, y, z: centre, w: reach (radius and margin), all of them finite and w > 0.
  explicit LevelGrid(std::vector<Quad> spheres);

  /// Calls found(j) for every j with |x_i - x_j| < w_i + w_j that i is the one to find: each pair is found
  /// once, by the one of the lower level, or of two on one level by the one that stands first in its grid.
  template <class Found>
  void for_each_near(std::uint32_t i, const Found& found) const {
    const Quad& x = spheres_[i];
    look_forward(levels_[level_[i]], i, x, found);
    for (std::size_t l = level_[i] + 1U; l < levels_.size(); ++l) look_around(levels_[l], x, found);
  }
  /// Calls found(j) for every j with |x - x_j| < x.w + w_j.
  template <class Found>
  void for_each_within(const Quad& x, const Found& found) const {
    for (const Level& level : levels_)
      if (!level.order.empty()) look_around(level, x, found);
  }
  std::size_t levels() const { return levels_.size(); }

 private:
  struct Level {
    double low[3] = {0, 0, 0}, width = 1, reach = 0;  // corner, edge of a cell, largest reach [m]
    std::int64_t size[3] = {0, 0, 0};
    std::vector<std::uint32_t> start;  // of each cell in `order`
    std::vector<std::uint32_t> order;  // sphere numbers, cell by cell
    std::vector<Quad> place;           // of these, side by side

    std::int64_t cell(double x, int axis) const {
      const auto c = static_cast<std::int64_t>((x - low[axis]) / width);
      return c < 0 ? 0 : c >= size[axis] ? size[axis] - 1 : c;
    }
    std::size_t row(std::int64_t y, std::int64_t z) const {
      return static_cast<std::size_t>((z * size[1] + y) * size[0]);
    }
  };

  void fill(Level& level, const std::vector<std::uint32_t>& members);

  template <class Found>
  static void look_in(const Level& level, std::uint32_t from, std::uint32_t to, const Quad& x,
                      const Found& found) {
    for (std::uint32_t k = from; k < to; ++k) {
      const Quad& y = level.place[k];
      const double dx = x.x - y.x, dy = x.y - y.y, dz = x.z - y.z, reach = x.w + y.w;
      if (dx * dx + dy * dy + dz * dz < reach * reach) found(level.order[k]);
    }
  }
  /// Cells x0 to x1 of a row.
  template <class Found>
  static void look_in_row(const Level& level, std::int64_t x0, std::int64_t x1, std::int64_t y,
                          std::int64_t z, const Quad& x, const Found& found) {
    if (y < 0 || y >= level.size[1] || z < 0 || z >= level.size[2]) return;
    x0 = x0 < 0 ? 0 : x0;
    x1 = x1 >= level.size[0] ? level.size[0] - 1 : x1;
    if (x0 > x1) return;
    const std::size_t row = level.row(y, z);
    look_in(level, level.start[row + static_cast<std::size_t>(x0)],
            level.start[row + static_cast<std::size_t>(x1) + 1], x, found);
  }
  template <class Found>
  void look_forward(const Level& level, std::uint32_t i, const Quad& q, const Found& found) const {
    const std::int64_t x = level.cell(q.x, 0), y = level.cell(q.y, 1), z = level.cell(q.z, 2);
    const std::size_t end = level.row(y, z) + static_cast<std::size_t>(x) + 1;
    look_in(level, slot_[i] + 1, level.start[end], q, found);
    look_in_row(level, x + 1, x + 1, y, z, q, found);
    look_in_row(level, x - 1, x + 1, y + 1, z, q, found);
    for (std::int64_t dy = -1; dy <= 1; ++dy) look_in_row(level, x - 1, x + 1, y + dy, z + 1, q, found);
  }
  template <class Found>
  static void look_around(const Level& level, const Quad& q, const Found& found) {
    const double reach = q.w + level.reach;
    const std::int64_t x0 = level.cell(q.x - reach, 0), x1 = level.cell(q.x + reach, 0);
    const std::int64_t y0 = level.cell(q.y - reach, 1), y1 = level.cell(q.y + reach, 1);
    const std::int64_t z0 = level.cell(q.z - reach, 2), z1 = level.cell(q.z + reach, 2);
    for (std::int64_t z = z0; z <= z1; ++z)
      for (std::int64_t y = y0; y <= y1; ++y) look_in_row(level, x0, x1, y, z, q, found);
  }

  std::vector<Quad> spheres_;
  std::vector<Level> levels_;
  std::vector<std::uint8_t> level_;  // of each sphere
  std::vector<std::uint32_t> slot_;  // of each sphere in its level's order
};

}  // namespace packbed
