#pragma once
// Doubles side by side. Four: a vector in memory, the unit of loops over spheres. Lanes (L: Four or Eight):
// one number of each of so many contacts. Plain arithmetic of the compiler's vector types, so the values are
// the same whatever the machine's vectors are.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace packbed {

#define PACKBED_INLINE inline __attribute__((always_inline))
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));
template <class L>
inline constexpr std::size_t kWidth = sizeof(L) / sizeof(double);
template <class L>
using Flags = decltype(L{} < L{});  // 0 or -1

/// A vector in memory with one more number beside it: one load, one cache line at most.
struct alignas(32) Quad {
  double x = 0, y = 0, z = 0, w = 0;
};

PACKBED_INLINE Four& four(Quad& q) {
  return *reinterpret_cast<Four*>(&q);
}
PACKBED_INLINE const Four& four(const Quad& q) {
  return *reinterpret_cast<const Four*>(&q);
}
PACKBED_INLINE Four four(double x) {
  return Four{x, x, x, x};
}
PACKBED_INLINE bool any(const Flags<Four>& f) {
#if defined(__SSE2__) && defined(__GNUC__) && !defined(__clang__)
  using Two = double __attribute__((vector_size(16)));
  return __builtin_ia32_movmskpd(
             Two(__builtin_shufflevector(f, f, 0, 1) |  // the compiler would take it apart
                 __builtin_shufflevector(f, f, 2, 3))) != 0;
#else
  return (f[0] | f[1] | f[2] | f[3]) != 0;
#endif
}

template <class L>
PACKBED_INLINE L all(double x) {
  return L{} + x;
}
template <class L>
PACKBED_INLINE L root(const L& v) {
  L out;
  for (std::size_t i = 0; i < kWidth<L>; ++i) out[i] = std::sqrt(v[i]);
  return out;
}
template <class L>
PACKBED_INLINE L larger(const L& a, const L& b) {
  return a > b ? a : b;
}
template <class L>
PACKBED_INLINE L smaller(const L& a, const L& b) {
  return a < b ? a : b;
}
PACKBED_INLINE bool any(const Flags<Eight>& f) {
  return any(__builtin_shufflevector(f, f, 0, 1, 2, 3) | __builtin_shufflevector(f, f, 4, 5, 6, 7));
}

template <class L>
struct LaneVec {
  L x{}, y{}, z{};
};
template <class L>
PACKBED_INLINE LaneVec<L> operator+(const LaneVec<L>& a, const LaneVec<L>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class L>
PACKBED_INLINE LaneVec<L> operator-(const LaneVec<L>& a, const LaneVec<L>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class L>
PACKBED_INLINE LaneVec<L> operator*(const L& k, const LaneVec<L>& v) {
  return {k * v.x, k * v.y, k * v.z};
}
template <class L>
PACKBED_INLINE LaneVec<L> operator*(double k, const LaneVec<L>& v) {
  return {k * v.x, k * v.y, k * v.z};
}
template <class L>
PACKBED_INLINE L dot(const LaneVec<L>& a, const LaneVec<L>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class L>
PACKBED_INLINE LaneVec<L> cross(const LaneVec<L>& a, const LaneVec<L>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class L>
PACKBED_INLINE LaneVec<L> choose(const Flags<L>& f, const LaneVec<L>& a, const LaneVec<L>& b) {
  return {f ? a.x : b.x, f ? a.y : b.y, f ? a.z : b.z};
}

/// A Quad of each lane, component by component.
template <class L>
struct LaneQuads {
  L x, y, z, w;
};
template <class L>
PACKBED_INLINE LaneVec<L> vec(const LaneQuads<L>& q) {
  return {q.x, q.y, q.z};
}

/// Two numbers, one after the other in memory, from each of two places. Halves of a Quad can be loaded where
/// they are wanted, which spares half of the shuffles.
PACKBED_INLINE Four joined(const double& low, const double& high) {
  using Two = double __attribute__((vector_size(16)));
  return __builtin_shufflevector(reinterpret_cast<const Two&>(low), reinterpret_cast<const Two&>(high), 0, 1,
                                 2, 3);
}
PACKBED_INLINE Eight joined(const Four& low, const Four& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
/// The Quads with these numbers, one a lane.
template <class L>
PACKBED_INLINE LaneQuads<L> gather(const Quad* from, const std::uint32_t* at);
template <>
PACKBED_INLINE LaneQuads<Four> gather<Four>(const Quad* from, const std::uint32_t* at) {
  const Quad &a = from[at[0]], &b = from[at[1]], &c = from[at[2]], &d = from[at[3]];
  const Four ac_xy = joined(a.x, c.x), bd_xy = joined(b.x, d.x);
  const Four ac_zw = joined(a.z, c.z), bd_zw = joined(b.z, d.z);
  return {
      __builtin_shufflevector(ac_xy, bd_xy, 0, 4, 2, 6), __builtin_shufflevector(ac_xy, bd_xy, 1, 5, 3, 7),
      __builtin_shufflevector(ac_zw, bd_zw, 0, 4, 2, 6), __builtin_shufflevector(ac_zw, bd_zw, 1, 5, 3, 7)};
}
template <>
PACKBED_INLINE LaneQuads<Eight> gather<Eight>(const Quad* from, const std::uint32_t* at) {
  const auto two = [&](std::size_t k) __attribute__((always_inline)) {
    return joined(four(from[at[k]]), four(from[at[k + 4]]));
  };
  const Eight row_04 = two(0), row_15 = two(1), row_26 = two(2), row_37 = two(3);
  const Eight xz_01 = __builtin_shufflevector(row_04, row_15, 0, 8, 2, 10, 4, 12, 6, 14),
              yw_01 = __builtin_shufflevector(row_04, row_15, 1, 9, 3, 11, 5, 13, 7, 15),
              xz_23 = __builtin_shufflevector(row_26, row_37, 0, 8, 2, 10, 4, 12, 6, 14),
              yw_23 = __builtin_shufflevector(row_26, row_37, 1, 9, 3, 11, 5, 13, 7, 15);
  return {__builtin_shufflevector(xz_01, xz_23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(yw_01, yw_23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(xz_01, xz_23, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(yw_01, yw_23, 2, 3, 10, 11, 6, 7, 14, 15)};
}

/// A Quad of each lane, lane by lane.
template <class L>
using LaneRows = std::array<Four, kWidth<L>>;
PACKBED_INLINE LaneRows<Four> rows(const LaneVec<Four>& v, const Four& w) {
  const Four even_xy = __builtin_shufflevector(v.x, v.y, 0, 4, 2, 6),
             odd_xy = __builtin_shufflevector(v.x, v.y, 1, 5, 3, 7);
  const Four even_zw = __builtin_shufflevector(v.z, w, 0, 4, 2, 6),
             odd_zw = __builtin_shufflevector(v.z, w, 1, 5, 3, 7);
  return {__builtin_shufflevector(even_xy, even_zw, 0, 1, 4, 5),
          __builtin_shufflevector(odd_xy, odd_zw, 0, 1, 4, 5),
          __builtin_shufflevector(even_xy, even_zw, 2, 3, 6, 7),
          __builtin_shufflevector(odd_xy, odd_zw, 2, 3, 6, 7)};
}
PACKBED_INLINE Four low(const Eight& v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3);
}
PACKBED_INLINE Four high(const Eight& v) {
  return __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
PACKBED_INLINE LaneRows<Eight> rows(const LaneVec<Eight>& v, const Eight& w) {
  const Eight even_xy = __builtin_shufflevector(v.x, v.y, 0, 8, 2, 10, 4, 12, 6, 14),
              odd_xy = __builtin_shufflevector(v.x, v.y, 1, 9, 3, 11, 5, 13, 7, 15),
              even_zw = __builtin_shufflevector(v.z, w, 0, 8, 2, 10, 4, 12, 6, 14),
              odd_zw = __builtin_shufflevector(v.z, w, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight row_04 = __builtin_shufflevector(even_xy, even_zw, 0, 1, 8, 9, 4, 5, 12, 13),
              row_15 = __builtin_shufflevector(odd_xy, odd_zw, 0, 1, 8, 9, 4, 5, 12, 13),
              row_26 = __builtin_shufflevector(even_xy, even_zw, 2, 3, 10, 11, 6, 7, 14, 15),
              row_37 = __builtin_shufflevector(odd_xy, odd_zw, 2, 3, 10, 11, 6, 7, 14, 15);
  return {low(row_04),  low(row_15),  low(row_26),  low(row_37),
          high(row_04), high(row_15), high(row_26), high(row_37)};
}

/// Lanes in memory, as many as the widest of them; narrower ones go from part to part.
inline constexpr std::size_t kLanes = kWidth<Eight>;
using LaneNumbers = std::array<std::uint32_t, kLanes>;
struct alignas(64) LaneRow {
  std::array<double, kLanes> value{};
};
template <class L>
PACKBED_INLINE L& part(LaneRow& row, std::size_t first) {
  return *reinterpret_cast<L*>(row.value.data() + first);
}
template <class L>
PACKBED_INLINE const L& part(const LaneRow& row, std::size_t first) {
  return *reinterpret_cast<const L*>(row.value.data() + first);
}
inline double total(const LaneRow& row) {
  const std::array<double, kLanes>& v = row.value;
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
}  // namespace packbed
