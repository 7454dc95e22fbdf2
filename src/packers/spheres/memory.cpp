// Where spheres stand in memory, and where what they do to spheres of other chunks is left.
#include <algorithm>
#include <array>
#include <numeric>

#include "math/threads.hpp"
#include "packers/spheres/search.hpp"

namespace packbed::spheres {
namespace {

// Searches between two sorts of the memory.
constexpr std::int64_t kSortEvery = 4;

/// Bits of a number below 2^21, two zeros between each.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

/// The order of the spheres along a Z-curve through cells as wide as the smallest sphere.
std::vector<std::uint32_t> curve_order(const Spheres& s) {
  Box3 box;
  double smallest = 1e300;
  for (const Quad& x : s.place) box.extend(vec(x)), smallest = std::min(smallest, 2.0 * x.w);
  const double width = std::max(smallest, box.sizes().maxCoeff() / 2e6);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> key(s.size());
  for (std::uint32_t i = 0; i < s.size(); ++i) {
    const Vec3 cell = (vec(s.place[i]) - box.min()) / width;
    const auto at = [&](int k) { return spread(static_cast<std::uint64_t>(cell[k])); };
    key[i] = {at(0) | at(1) << 1 | at(2) << 2, i};
  }
  std::sort(key.begin(), key.end());
  std::vector<std::uint32_t> order(s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = key[i].second;
  return order;
}

template <class T>
void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  std::vector<T> sorted(order.size());
  parallel_for(order.size(), 4096, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) sorted[i] = values[order[i]];
  });
  values.swap(sorted);
}

}  // namespace

Before sort_memory(State& state) {
  Spheres& s = state.spheres;
  const std::size_t n = s.size();
  const std::size_t listed = state.slot_first.empty() ? 0 : state.slot_first.size() - 1;
  for (std::vector<Quad>* of : {&s.force, &s.twist}) {
    of->resize(listed);  // the slots go; nothing acts yet on who has entered
    of->resize(n);
  }
  if (state.searches % kSortEvery != 0) {
    Before same(n);
    std::iota(same.begin(), same.end(), 0U);
    return same;
  }
  Before order = curve_order(s);
  reorder(s.id, order), reorder(s.kind, order), reorder(s.scale, order);
  reorder(s.place, order), reorder(s.velocity, order), reorder(s.spin, order);
  reorder(s.force, order), reorder(s.twist, order), reorder(s.listed_at, order);
  Sleepers::each_of(state.sleepers, [&](auto& of) { reorder(of, order); });
  if (!state.gear.spin_ahead.empty()) {
    for (std::vector<Quad>& of : state.gear.position) reorder(of, order);
    for (std::vector<Quad>& of : state.gear.spin) reorder(of, order);
    reorder(state.gear.ahead, order), reorder(state.gear.spin_ahead, order);
  }
  return order;
}

void give_slots(State& state) {
  struct Foreign {  // a pair whose second sphere is another chunk's
    std::size_t lane;
    std::uint32_t b;
  };
  Spheres& s = state.spheres;
  const std::size_t n = s.size();
  const std::array<List*, 2> lists{&state.pairs, &state.near};
  std::vector<std::array<std::vector<Foreign>, 2>> found(chunks_of(n));
  for_each_chunk(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t k = 0; k < lists.size(); ++k)
      for (std::size_t p = kLanes * lists[k]->block_of(begin); p < kLanes * lists[k]->block_of(end); ++p)
        if (const std::uint32_t b = lists[k]->b(p); b / kChunk != c) found[c][k].push_back({p, b});
  });
  state.slot_first.assign(n + 1, 0);
  state.first_slot.assign(1, static_cast<std::uint32_t>(n));
  auto slots = static_cast<std::uint32_t>(n);
  for (const auto& of_chunk : found) {
    for (std::size_t k = 0; k < lists.size(); ++k)
      for (const Foreign& f : of_chunk[k]) {
        lists[k]->block[f.lane / kLanes].to[f.lane % kLanes] = slots++;
        ++state.slot_first[f.b + 1];
      }
    state.first_slot.push_back(slots);
  }
  std::partial_sum(state.slot_first.begin(), state.slot_first.end(), state.slot_first.begin());
  state.slot.resize(slots - n);
  std::vector<std::uint32_t> next(state.slot_first.begin(), state.slot_first.end() - 1);
  auto slot = static_cast<std::uint32_t>(n);
  for (const auto& of_chunk : found)
    for (const auto& pairs : of_chunk)
      for (const Foreign& f : pairs) state.slot[next[f.b]++] = slot++;
  s.force.resize(slots);
  s.twist.resize(slots);
}

}  // namespace packbed::spheres
