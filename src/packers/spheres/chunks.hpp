#pragma once
// What the loops over spheres share.
#include <algorithm>

#include "math/threads.hpp"
#include "packers/spheres/model.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed::spheres {

/// Calls body(chunk, begin, end) for each chunk of spheres.
template <class Body>
void for_each_chunk(std::size_t spheres, const Body& body) {
  parallel_for(chunks_of(spheres), 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t c = from; c < to; ++c) body(c, c * kChunk, std::min(spheres, (c + 1) * kChunk));
  });
}

inline Vec3 vec(const Quad& q) {
  return {q.x, q.y, q.z};
}
PACKBED_INLINE Four four_of(const Vec3& v) {
  return Four{v.x(), v.y(), v.z(), 0.0};
}
PACKBED_INLINE Four spread_w(const Quad& q) {
  return four(q.w);
}
PACKBED_INLINE Four without_w(const Quad& q) {
  return four(q) * Four{1.0, 1.0, 1.0, 0.0};
}
PACKBED_INLINE Four only_w(const Quad& q) {
  return four(q) * Four{0.0, 0.0, 0.0, 1.0};
}
/// Square of the distance of two places.
PACKBED_INLINE double way_from(const Quad& a, const Quad& b) {
  const Four way = four(a) - four(b), squares = way * way;
  return squares[0] + squares[1] + squares[2];
}

/// Rate of the spin of sphere i [rad/s2].
PACKBED_INLINE Four turn_of(const Spheres& s, std::size_t i) {
  return four(-s.place[i].w * s.spin[i].w) * four(s.twist[i]);
}

/// What acted at the end of the last step is of no use any more.
PACKBED_INLINE void clear_forces(const Model& model, Spheres& s, std::size_t i) {
  four(s.force[i]) = Four{};
  if (model.turns) four(s.twist[i]) = Four{};
}

/// Whether nothing touches sphere i, as far as its own chunk knows.
PACKBED_INLINE bool is_free(const State& state, std::size_t i) {
  const Spheres& s = state.spheres;
  return state.slot_first[i] == state.slot_first[i + 1] &&
         !any((four(s.force[i]) != 0.0) | (four(s.twist[i]) != 0.0));
}

/// Adds what other chunks have left for sphere i.
PACKBED_INLINE void gather_slots(const State& state, std::size_t i, std::vector<Quad>& force) {
  for (std::uint32_t k = state.slot_first[i]; k < state.slot_first[i + 1]; ++k)
    four(force[i]) += four(force[state.slot[k]]);
}

/// Whether sphere i has gone farther than its lists allow.
PACKBED_INLINE bool has_strayed(const Spheres& s, std::size_t i) {
  return way_from(s.place[i], s.listed_at[i]) > s.listed_at[i].w;
}

/// The step has moved the spheres.
inline void end_of_drift(const Model& model, State& state) {
  ++state.steps;
  state.time += model.step;
  state.ledger.listed +=
      static_cast<double>(state.pairs.lanes() + state.near.lanes() + state.late.pairs.lanes());
}

}  // namespace packbed::spheres

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
