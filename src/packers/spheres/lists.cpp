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

void append(List& list, std::uint32_t a, std::uint32_t b, std::uint32_t idle) {
  const std::size_t p = list.filled++;
  if (p % kLanes == 0) list.block.push_back({all_lanes(a), all_lanes(idle), all_lanes(idle)});
  PairBlock& block = list.block.back();
  block.a[p % kLanes] = a;
  block.b[p % kLanes] = block.to[p % kLanes] = b;
}

bool take_over(List& from, std::uint32_t a, std::uint32_t b, double sign, std::uint32_t idle, List& to) {
  const auto old = find_pair(from, a, b);
  if (!old) return false;
  copy_memory(from, *old, sign, to, to.filled - 1);
  from.block[*old / kLanes].b[*old % kLanes] = idle;
  return true;
}

OldLists::OldLists(std::vector<List> lists, List late) : lists_(std::move(lists)), late_(std::move(late)) {
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
