// Phase find_pairs of digidem: which pellets may touch each other or the container before the next search.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "packers/lattice/dem.hpp"

namespace packbed::lattice {
namespace {

bool before(const Touch& s, const Touch& t) {
  return s.a != t.a ? s.a < t.a : s.b < t.b;
}

/// A pellet whose bounding sphere, grown by the margin, may reach the floor or the wall.
void list_container(const DemModel& model, const DemState& state, std::size_t i, double margin,
                    std::vector<Touch>& list) {
  const Container& c = model.base.scene->container;
  const Vec3& x = state.bodies.position[i];
  const double reach = state.bodies.bounding_radius[i] + margin;
  const auto add = [&](std::uint32_t b) {
    Touch touch;
    touch.a = static_cast<std::uint32_t>(i);
    touch.b = b;
    list.push_back(touch);
  };
  if (c.kind == ContainerKind::tube && x.z() < reach) add(kFloor);
  if (c.kind != ContainerKind::tube || x.head<2>().norm() + reach > c.radius) add(kSide);
}

}  // namespace

void dem_find_pairs(const DemModel& model, DemState& state) {
  const Bodies& b = state.bodies;
  const double go = 0.5 * model.skin;
  for (std::size_t i = 0; i < state.size() && !state.search_due; ++i)
    state.search_due =
        b.motion[i] == Motion::awake && (b.position[i] - state.listed_at[i]).squaredNorm() > go * go;
  if (!state.search_due) return;
  // two cells more: a stamp lies up to a cell from its pellet, and touches are seen a cell before they begin
  const double margin = go + 2 * model.base.frame.pitch;
  std::vector<std::uint32_t> all(state.size());
  std::iota(all.begin(), all.end(), 0U);
  std::vector<double> reach(state.size());
  std::vector<std::uint8_t> still(state.size());
  for (std::size_t i = 0; i < state.size(); ++i) {
    reach[i] = b.bounding_radius[i] + margin;
    still[i] = b.motion[i] == Motion::fixed;
  }
  std::vector<BodyPair> pairs;
  NeighbourSearch().find(all, b.position, reach, still, pairs);
  std::vector<Touch> list;
  std::size_t next = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    for (; next < pairs.size() && pairs[next].a == i; ++next) {
      Touch touch;
      touch.a = pairs[next].a;
      touch.b = pairs[next].b;
      list.push_back(touch);
    }
    if (!still[i]) list_container(model, state, i, margin, list);
  }
  auto old = state.touches.begin();
  for (Touch& touch : list) {
    while (old != state.touches.end() && before(*old, touch)) ++old;
    if (old != state.touches.end() && !before(touch, *old)) touch = *old;
  }
  state.touches = std::move(list);
  state.listed_at = b.position;
  state.search_due = 0;
  state.stale = 1;
  ++state.searches;
}

}  // namespace packbed::lattice
