// Between two searches: spheres that have left their margin, a hit one most often, get partners of their own
// without a search for all. What they may touch now and is in no list yet goes into the late lists, which
// the next search empties.
#include <algorithm>
#include <cmath>

#include "math/threads.hpp"
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

/// Who a sphere may touch from now on without a list of the search saying so: spheres, which may be in a late
/// pair with it, and walls, for which the same holds.
struct Partners {
  std::vector<std::uint32_t> spheres, walls;
};

Partners partners_of(const Model& model, const State& state, std::uint32_t i) {
  const Spheres& s = state.spheres;
  const Late& late = state.late;
  Partners found;
  const auto consider = [&](std::uint32_t j) {
    if (j == i || !(s.velocity[i].w > 0 || s.velocity[j].w > 0)) return;
    const auto lists = [&](const List& list) { return find_pair(list, i, j) || find_pair(list, j, i); };
    if (!lists(state.pairs) && !lists(state.near)) found.spheres.push_back(j);
  };
  const Quad ball = ball_of(s, i);
  late.grid->for_each_within(ball, [&](std::uint32_t j) {
    if (!has_moved(state, j)) consider(j);
  });
  for (std::uint32_t j : late.moved)
    if (meet(ball, ball_of(s, j))) consider(j);
  for_each_wall_near(model, ball, [&](std::uint32_t wall) {
    if (!find_pair(state.walls, i, wall)) found.walls.push_back(wall);
  });
  return found;
}

void list_pair(const Model& model, State& state, std::uint32_t i, std::uint32_t j) {
  Late& late = state.late;
  if (are_linked(late.chains, late.pairs, i, j)) return;
  append(late.pairs, i, j, i);
  link(late.chains, late.pairs, late.pairs.filled - 1);
  make_memory(model, late.pairs);
  if (!take_over(state.still, i, j, 1.0, i, late.pairs)) take_over(state.still, j, i, -1.0, j, late.pairs);
  come_to_shore(state.sleepers, j);
}

void list_wall(const Model& model, State& state, std::uint32_t i, std::uint32_t wall) {
  List& late = state.late.walls;
  for (std::size_t p = 0; p < late.filled; ++p)
    if (late.a(p) == i && late.b(p) == wall) return;
  append(late, i, wall, idle_wall(model));
  make_memory(model, late);
  take_over(state.still_walls, i, wall, 1.0, idle_wall(model), late);
}

/// `spheres`: whose partners are not all in lists.
void list_anew(const Model& model, State& state, const std::vector<std::uint32_t>& spheres) {
  Late& late = state.late;
  if (!late.grid) {
    late.grid = std::make_shared<LevelGrid>(late.reach);
    late.chains = chains_of(late.pairs, state.spheres.size());
  }
  std::vector<Partners> partners(spheres.size());
  parallel_for(spheres.size(), 4, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) partners[k] = partners_of(model, state, spheres[k]);
  });
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    for (std::uint32_t j : partners[k].spheres) list_pair(model, state, spheres[k], j);
    for (std::uint32_t wall : partners[k].walls) list_wall(model, state, spheres[k], wall);
  }
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
    give_margin(model, state, i, moves(state, i) && is_free(state, i));
  }
  list_anew(model, state, strays);
  std::fill(state.strayed.begin(), state.strayed.end(), std::uint8_t{0});
  state.relisted += static_cast<std::int64_t>(strays.size());
  return true;
}

}  // namespace packbed::spheres
