#pragma once
// What a search of all spheres and one of a few share.
#include <cmath>

#include "packers/spheres/chunks.hpp"
#include "packers/spheres/lists.hpp"

namespace packbed::spheres {

/// Where each sphere stood when the last lists were made; who has entered since comes after those.
using Before = std::vector<std::uint32_t>;
/// Drops the slots, and puts the spheres in the order of the curve when that is due.
Before sort_memory(State& state);
/// A pair whose second sphere is another chunk's leaves its force in a slot.
void give_slots(State& state);

/// Lets sphere i go on from where it is without leaving its lists. `flies`: nothing touches it.
void give_margin(const Model& model, State& state, std::size_t i, bool flies);

/// Where sphere i may be until it is listed again: centre and how far its surface may reach [m].
inline Quad ball_of(const Spheres& s, std::size_t i) {
  const Quad& x = s.listed_at[i];
  return {x.x, x.y, x.z, s.place[i].w + std::sqrt(x.w)};
}

/// Whether sphere i is neither fixed nor asleep.
inline bool moves(const State& state, std::size_t i) {
  return state.spheres.velocity[i].w > 0 && state.sleepers.is[i] == Sleepers::kAwake;
}

/// Whether two balls, centre and radius, share room.
inline bool meet(const Quad& a, const Quad& b) {
  const double reach = a.w + b.w;
  return way_from(a, b) < reach * reach;
}

/// The wall that lanes of no use name. Of a mesh container there is one wall, number 0, and any other number
/// is none.
inline std::uint32_t idle_wall(const Model& model) {
  return model.solid ? 1U : static_cast<std::uint32_t>(model.walls.size() - 1);
}

/// Calls found(wall) for each wall that the ball reaches.
template <class Found>
void for_each_wall_near(const Model& model, const Quad& ball, const Found& found) {
  const Vec3 x(ball.x, ball.y, ball.z);
  for (std::uint32_t w = 0; w + 1 < model.walls.size(); ++w) {
    const Quad& wall = model.walls[w];
    const Vec3 normal(wall.x, wall.y, wall.z);
    const bool round = normal.squaredNorm() < 0.5;
    if ((round ? wall.w - std::hypot(x.x(), x.y()) : normal.dot(x) - wall.w) < ball.w) found(w);
  }
  if (model.solid && model.solid->distance(x) < ball.w) found(0U);
}

/// New lists for the spheres that have left their margins; false when they are too many, and nothing is done.
bool relist(const Model& model, State& state);
/// New lists for spheres that slept and do no more, or a search for all.
void list_woken(const Model& model, State& state, const std::vector<std::uint32_t>& woken);

}  // namespace packbed::spheres
