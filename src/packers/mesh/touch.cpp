// Phase touch: every pair that may have come into contact is looked at, and its forces go into its own slot.
#include <algorithm>

#include "math/threads.hpp"
#include "packers/mesh/kernels.hpp"
#include "packers/mesh/patches.hpp"
#include "packers/mesh/push.hpp"
#include "packers/mesh/step.hpp"

namespace packbed::mesh {
namespace {

// Pairs between the one looked at and the one whose record is fetched.
constexpr std::size_t kAhead = 6;

double travel_of(const State& state, std::uint32_t p) {
  const auto [a, b] = state.pairs.pair[p];
  const std::vector<double>& travel = state.bodies.travel;
  return travel[a] + (is_container(b) ? 0.0 : travel[b]);
}

RodFeatures& features_of(Pairs& pairs, std::uint32_t p) {
  return pairs.features[pairs.slot[p]];
}

void take(const Model& model, State& state, std::uint32_t p, const Touch& t, double gap) {
  PairRecord& r = state.pairs.record[p];
  Load& load = state.pairs.load[p];
  if (t.delta > 0) {
    load = Load{};
    r.elastic = 0;
    push(model, state.bodies, state.pairs.pair[p], t, r.spring, load, r);
    load.delta = t.delta;
    count_touch(model, state.bodies, state.pairs.pair[p], t.depth, r);
    return;
  }
  if (load.delta > 0) part(load, r);
  state.pairs.look_at[p] = travel_of(state, p) + std::max(0.0, gap);
}

void look_afresh(const Model& model, State& state, std::uint32_t p) {
  double gap = 0;
  const Touch t = touch_pair(model, state.bodies, state.pairs.pair[p], features_of(state.pairs, p), gap);
  take(model, state, p, t, gap);
}

/// The pairs of cylinders that were queued.
void look_at_rods(const Model& model, State& state, RodLooks& looks) {
  looks.finish([&](std::uint32_t p, const Touch& t, bool lost) {
    if (lost)
      look_afresh(model, state, p);
    else
      take(model, state, p, t, features_of(state.pairs, p).due());
  });
}

template <class T>
void fetch(const T& value) {  // soon to be used, on its way into the cache
  const auto* line = reinterpret_cast<const char*>(&value);
  for (std::size_t at = 0; at < sizeof(T); at += 64) __builtin_prefetch(line + at, 1);
}

void look(const Model& model, State& state, std::uint32_t p, RodLooks& looks) {
  if (uses_fields(model)) {
    look_at_patches(model, state, p, travel_of(state, p));
    return;
  }
  RodFeatures& features = features_of(state.pairs, p);
  if (!features.known) {
    look_afresh(model, state, p);
    return;
  }
  const auto [a, b] = state.pairs.pair[p];
  looks.add(p, rod_of(model, state.bodies, a), rod_of(model, state.bodies, b), features);
  if (looks.full()) look_at_rods(model, state, looks);
}

}  // namespace

void touch(const Model& model, State& state) {
  const std::vector<std::uint32_t>& active = state.pairs.active;
  state.ledger.active += static_cast<double>(active.size());
  parallel_for_uneven(active.size(), 64, [&](std::size_t from, std::size_t to) {
    thread_local RodLooks looks;
    thread_local std::vector<std::uint32_t> due;
    due.clear();
    for (std::size_t k = from; k < to; ++k)
      if (travel_of(state, active[k]) >= state.pairs.look_at[active[k]]) due.push_back(active[k]);
    for (std::size_t k = 0; k < due.size(); ++k) {
      if (const std::size_t next = k + kAhead; next < due.size()) {
        fetch(state.pairs.record[due[next]]);
        if (!uses_fields(model)) fetch(features_of(state.pairs, due[next]));
      }
      look(model, state, due[k], looks);
    }
    look_at_rods(model, state, looks);
  });
}

}  // namespace packbed::mesh
