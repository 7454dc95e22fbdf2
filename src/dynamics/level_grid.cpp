#include "dynamics/level_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace packbed {

LevelGrid::LevelGrid(std::vector<Quad> spheres)
    : spheres_(std::move(spheres)), level_(spheres_.size()), slot_(spheres_.size()) {
  double smallest = 0;
  for (const Quad& s : spheres_) smallest = smallest > 0 ? std::min(smallest, s.w) : s.w;
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < spheres_.size(); ++i) {
    const int level = std::max(0, std::ilogb(spheres_[i].w / smallest));
    level_[i] = static_cast<std::uint8_t>(level);
    members.resize(std::max(members.size(), level_[i] + std::size_t{1}));
    members[level_[i]].push_back(i);
  }
  levels_.resize(members.size());
  for (std::size_t l = 0; l < levels_.size(); ++l) fill(levels_[l], members[l]);
}

void LevelGrid::fill(Level& level, const std::vector<std::uint32_t>& members) {
  if (members.empty()) return;
  double high[3];
  for (int k = 0; k < 3; ++k) level.low[k] = INFINITY, high[k] = -INFINITY;
  for (std::uint32_t i : members) {
    const double x[3] = {spheres_[i].x, spheres_[i].y, spheres_[i].z};
    for (int k = 0; k < 3; ++k)
      level.low[k] = std::min(level.low[k], x[k]), high[k] = std::max(high[k], x[k]);
    level.reach = std::max(level.reach, spheres_[i].w);
  }
  // as wide as two of the largest can reach, but never more than some four cells a sphere
  double room = 1;
  for (int k = 0; k < 3; ++k) room *= std::max(high[k] - level.low[k], 2.0 * level.reach);
  level.width = std::max(2.0 * level.reach, std::cbrt(room / (4.0 * static_cast<double>(members.size()))));
  for (int k = 0; k < 3; ++k)
    level.size[k] = static_cast<std::int64_t>(std::min((high[k] - level.low[k]) / level.width, 4096.0)) + 1;
  const auto cell_of = [&](const Quad& x) {
    return level.row(level.cell(x.y, 1), level.cell(x.z, 2)) + static_cast<std::size_t>(level.cell(x.x, 0));
  };
  level.start.assign(static_cast<std::size_t>(level.size[0] * level.size[1] * level.size[2]) + 1, 0);
  for (std::uint32_t i : members) ++level.start[cell_of(spheres_[i]) + 1];
  for (std::size_t c = 1; c < level.start.size(); ++c) level.start[c] += level.start[c - 1];
  std::vector<std::uint32_t> next(level.start.begin(), level.start.end() - 1);
  level.order.resize(members.size());
  level.place.resize(members.size());
  for (std::uint32_t i : members) {
    slot_[i] = next[cell_of(spheres_[i])]++;
    level.order[slot_[i]] = i;
    level.place[slot_[i]] = spheres_[i];
  }
}

}  // namespace packbed
