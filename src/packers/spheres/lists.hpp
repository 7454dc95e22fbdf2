#pragma once
// Lists of pairs: looking one up, adding one, and what contacts remember handed on from old lists to new
// ones.
#include <initializer_list>
#include <optional>
#include <utility>

#include "packers/spheres/model.hpp"

namespace packbed::spheres {

/// Number of the pair (a, b) as a found it; nothing when it did not.
std::optional<std::size_t> find_pair(const List& list, std::uint32_t a, std::uint32_t b);

/// Pair p of a list that has room for it, and is filled lane by lane: the first of a block comes first.
void put(List& list, std::size_t p, std::uint32_t a, std::uint32_t b, std::uint32_t idle);
/// A new pair at the end; make_memory afterwards. `idle`: what lanes of no use have for b.
void append(List& list, std::uint32_t a, std::uint32_t b, std::uint32_t idle);

/// The lists of before a search, for what their contacts remember.
class OldLists {
 public:
  /// Takes them away. `late` is what was added to the others afterwards.
  OldLists(std::initializer_list<List*> lists, List& late);

  /// Gives pair p of `to` what the pair (a, b) remembered; `sign`: -1 when a and b have changed places. False
  /// when there was no such pair.
  bool hand_over(std::uint32_t a, std::uint32_t b, double sign, List& to, std::size_t p) const;

 private:
  std::vector<List> lists_;
  List late_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> place_;  // (a, b) and lane in late_, sorted
};

/// Moves the pair (a, b) of `from` to the last pair of `to`, with what it remembers; `idle` takes the place
/// of its b. False when there is no such pair.
bool take_over(List& from, std::uint32_t a, std::uint32_t b, double sign, std::uint32_t idle, List& to);

/// Adds pair p of the list, the one after those that the chains have.
void link(PairChains& chains, const List& list, std::size_t p);
PairChains chains_of(const List& list, std::size_t spheres);
/// Whether a and b are a pair in the list, in either order.
bool are_linked(const PairChains& chains, const List& list, std::uint32_t a, std::uint32_t b);

/// Room for what the contacts of a list remember.
void make_memory(const Model& model, List& list);

}  // namespace packbed::spheres
