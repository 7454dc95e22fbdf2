// Between two searches: spheres that have left their margin, a hit one most often, get partners of their own
// without a search for all. What they may touch now and is in no list yet goes into the late lists, which
// the next search empties.
#include <algorithm>
#include <cmath>

#include "packers/spheres/search.hpp"
#include "packers/spheres/sleep.hpp"

namespace packbed::spheres {
namespace {

// One sphere in so many may be listed anew before all are: more would walk over late pairs for longer than a
// search takes.
constexpr std::size_t kMovedShare = 64;

bool is_too_much(const State& state, std::size_t more) {
  return state.late.moved.size() + state.late.woken + more > state.spheres.size() / kMovedShare;
}

std::vector<std::uint32_t> strays_of(const Spheres& s, const std::vector<std::uint8_t>& strayed) {
  std::vector<std::uint32_t> strays;
  for (std::size_t c = 0; c < strayed.size(); ++c) {
    if (!strayed[c]) continue;
    const std::size_t end = std::min(s.size(), (c + 1) * kChunk);
    for (std::size_t i = c * kChunk; i < end; ++i)
      if (has_strayed(s, i)) strays.push_back(static_cast<std::uint32_t>(i));
  }
  return strays;
}

/// Whether sphere i has been listed anew since the search.
bool has_moved(const State& state, std::uint32_t i) {
  return way_from(state.late.reach[i], state.spheres.listed_at[i]) > 0;
}

bool holds(const std::vector<std::uint32_t>& values, std::uint32_t value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

void list_partners(const Model& model, State& state, std::uint32_t i) {
  const Spheres& s = state.spheres;
  Late& late = state.late;
  std::vector<std::uint32_t> had;
  for (std::size_t p = 0; p < late.pairs.filled; ++p) {
    if (late.pairs.a(p) == i) had.push_back(late.pairs.b(p));
    if (late.pairs.b(p) == i) had.push_back(late.pairs.a(p));
  }
  const auto consider = [&](std::uint32_t j) {
    if (j == i || !(s.velocity[i].w > 0 || s.velocity[j].w > 0)) return;
    const auto lists = [&](const List& list) { return find_pair(list, i, j) || find_pair(list, j, i); };
    if (holds(had, j) || lists(state.pairs) || lists(state.near)) return;
    append(late.pairs, i, j, i);
    had.push_back(j);
    make_memory(model, late.pairs);
    if (!take_over(state.still, i, j, 1.0, i, late.pairs)) take_over(state.still, j, i, -1.0, j, late.pairs);
    come_to_shore(state.sleepers, j);
  };
  const Quad ball = ball_of(s, i);
  late.grid->for_each_within(ball, [&](std::uint32_t j) {
    if (!has_moved(state, j)) consider(j);
  });
  for (std::uint32_t j : late.moved)
    if (meet(ball, ball_of(s, j))) consider(j);
}

void list_walls(const Model& model, State& state, std::uint32_t i) {
  List& late = state.late.walls;
  for_each_wall_near(model, ball_of(state.spheres, i), [&](std::uint32_t wall) {
    if (find_pair(state.walls, i, wall)) return;
    for (std::size_t p = 0; p < late.filled; ++p)
      if (late.a(p) == i && late.b(p) == wall) return;
    append(late, i, wall, idle_wall(model));
    make_memory(model, late);
    take_over(state.still_walls, i, wall, 1.0, idle_wall(model), late);
  });
}

/// `spheres`: whose partners are not all in lists.
void list_anew(const Model& model, State& state, const std::vector<std::uint32_t>& spheres) {
  if (!state.late.grid) state.late.grid = std::make_shared<LevelGrid>(state.late.reach);
  for (std::uint32_t i : spheres) list_partners(model, state, i), list_walls(model, state, i);
}

}  // namespace

void list_woken(const Model& model, State& state, const std::vector<std::uint32_t>& woken) {
  state.late.woken += woken.size();
  if (is_too_much(state, 0))
    state.search_due = 1;
  else
    list_anew(model, state, woken);
}

bool relist(const Model& model, State& state) {
  Late& late = state.late;
  const std::vector<std::uint32_t> strays = strays_of(state.spheres, state.strayed);
  if (is_too_much(state, strays.size())) return false;
  for (std::uint32_t i : strays) {
    if (!has_moved(state, i)) late.moved.push_back(i);
    give_margin(model, state, i);
  }
  list_anew(model, state, strays);
  std::fill(state.strayed.begin(), state.strayed.end(), std::uint8_t{0});
  state.relisted += static_cast<std::int64_t>(strays.size());
  return true;
}

}  // namespace packbed::spheres
