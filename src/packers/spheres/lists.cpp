#include "packers/spheres/lists.hpp"

#include <algorithm>

namespace packbed::spheres {
namespace {

void copy_spring(const SpringBlock& from, std::size_t old, double sign, SpringBlock& to, std::size_t p) {
  for (std::size_t d = 0; d < 3; ++d) to.stretch[d].value[p] = sign * from.stretch[d].value[old];
  to.stiffness.value[p] = from.stiffness.value[old];
}

void copy_memory(const List& from, std::size_t old, double sign, List& to, std::size_t p) {
  to.dash[p / kLanes].drag.value[p % kLanes] = from.dash[old / kLanes].drag.value[old % kLanes];
  to.dash[p / kLanes].closing.value[p % kLanes] = from.dash[old / kLanes].closing.value[old % kLanes];
  if (!to.slip.empty())
    copy_spring(from.slip[old / kLanes], old % kLanes, sign, to.slip[p / kLanes], p % kLanes);
  if (!to.roll.empty())
    copy_spring(from.roll[old / kLanes], old % kLanes, sign, to.roll[p / kLanes], p % kLanes);
}

LaneNumbers all_lanes(std::uint32_t n) {
  LaneNumbers all;
  all.fill(n);
  return all;
}

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{a} << 32 | b;
}

}  // namespace

std::optional<std::size_t> find_pair(const List& list, std::uint32_t a, std::uint32_t b) {
  if (a + 1 >= list.first.size()) return {};
  for (std::size_t p = list.first[a]; p < list.first[a + 1]; ++p)
    if (list.a(p) == a && list.b(p) == b) return p;  // those of a chunk's last sphere end in lanes of no use
  return {};
}

void make_memory(const Model& model, List& list) {
  list.dash.resize(list.block.size());
  list.slip.resize(model.turns ? list.block.size() : 0);
  list.roll.resize(model.rolls ? list.block.size() : 0);
}

void put(List& list, std::size_t p, std::uint32_t a, std::uint32_t b, std::uint32_t idle) {
  PairBlock& block = list.block[p / kLanes];
  if (p % kLanes == 0) block = {all_lanes(a), all_lanes(idle), all_lanes(idle)};
  block.a[p % kLanes] = a;
  block.b[p % kLanes] = block.to[p % kLanes] = b;
}

void append(List& list, std::uint32_t a, std::uint32_t b, std::uint32_t idle) {
  const std::size_t p = list.filled++;
  if (p % kLanes == 0) list.block.emplace_back();
  put(list, p, a, b, idle);
}

bool take_over(List& from, std::uint32_t a, std::uint32_t b, double sign, std::uint32_t idle, List& to) {
  const auto old = find_pair(from, a, b);
  if (!old) return false;
  copy_memory(from, *old, sign, to, to.filled - 1);
  from.block[*old / kLanes].b[*old % kLanes] = idle;
  return true;
}

void link(PairChains& chains, const List& list, std::size_t p) {
  const auto number = static_cast<std::uint32_t>(p + 1);
  chains.before.push_back({chains.last[list.a(p)], chains.last[list.b(p)]});
  chains.last[list.a(p)] = chains.last[list.b(p)] = number;
}

PairChains chains_of(const List& list, std::size_t spheres) {
  PairChains chains;
  chains.last.resize(spheres);
  for (std::size_t p = 0; p < list.filled; ++p) link(chains, list, p);
  return chains;
}

bool are_linked(const PairChains& chains, const List& list, std::uint32_t a, std::uint32_t b) {
  for (std::uint32_t n = chains.last[a]; n > 0;) {
    const std::uint32_t p = n - 1, first = list.a(p), second = list.b(p);
    if (first == b || second == b) return true;
    n = chains.before[p][first == a ? 0 : 1];
  }
  return false;
}

OldLists::OldLists(std::initializer_list<List*> lists, List& late) : late_(std::move(late)) {
  for (List* list : lists) lists_.push_back(std::move(*list));
  for (std::uint32_t p = 0; p < late_.filled; ++p) place_.push_back({key_of(late_.a(p), late_.b(p)), p});
  std::sort(place_.begin(), place_.end());
}

bool OldLists::hand_over(std::uint32_t a, std::uint32_t b, double sign, List& to, std::size_t p) const {
  for (const List& list : lists_)
    if (const auto old = find_pair(list, a, b)) {
      copy_memory(list, *old, sign, to, p);
      return true;
    }
  const auto found = std::lower_bound(place_.begin(), place_.end(), std::pair{key_of(a, b), 0U});
  if (found == place_.end() || found->first != key_of(a, b)) return false;
  copy_memory(late_, found->second, sign, to, p);
  return true;
}

}  // namespace packbed::spheres
