#pragma once
// Four doubles side by side, and vectors of them: the unit that loops over spheres work in. Plain arithmetic
// of the compiler's vector types, so the values are the same whatever the machine's vectors are.
#include <cmath>

namespace packbed {

#define PACKBED_INLINE inline __attribute__((always_inline))
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

using Four = double __attribute__((vector_size(32)));
using FourFlags = long __attribute__((vector_size(32)));  // 0 or -1, from a comparison

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
PACKBED_INLINE Four root(const Four& v) {
  Four out;
  for (int i = 0; i < 4; ++i) out[i] = std::sqrt(v[i]);
  return out;
}
PACKBED_INLINE Four larger(const Four& a, const Four& b) {
  return a > b ? a : b;
}
PACKBED_INLINE Four smaller(const Four& a, const Four& b) {
  return a < b ? a : b;
}
PACKBED_INLINE double total(const Four& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}
PACKBED_INLINE bool any(const FourFlags& f) {
#if defined(__SSE2__) && defined(__GNUC__) && !defined(__clang__)
  using Two = double __attribute__((vector_size(16)));
  return __builtin_ia32_movmskpd(
             Two(__builtin_shufflevector(f, f, 0, 1) |  // the compiler would take it apart
                 __builtin_shufflevector(f, f, 2, 3))) != 0;
#else
  return (f[0] | f[1] | f[2] | f[3]) != 0;
#endif
}

struct FourVec {
  Four x{}, y{}, z{};
};
PACKBED_INLINE FourVec operator+(const FourVec& a, const FourVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
PACKBED_INLINE FourVec operator-(const FourVec& a, const FourVec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
PACKBED_INLINE FourVec operator*(const Four& k, const FourVec& v) {
  return {k * v.x, k * v.y, k * v.z};
}
PACKBED_INLINE FourVec operator*(double k, const FourVec& v) {
  return {k * v.x, k * v.y, k * v.z};
}
PACKBED_INLINE Four dot(const FourVec& a, const FourVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
PACKBED_INLINE FourVec cross(const FourVec& a, const FourVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
PACKBED_INLINE FourVec choose(const FourFlags& f, const FourVec& a, const FourVec& b) {
  return {f ? a.x : b.x, f ? a.y : b.y, f ? a.z : b.z};
}

/// Four quads turned into four vectors, one component each, and back.
struct FourQuads {
  Four x, y, z, w;
};
PACKBED_INLINE FourQuads turned(const Four& a, const Four& b, const Four& c, const Four& d) {
  const Four ab_xz = __builtin_shufflevector(a, b, 0, 4, 2, 6),
             ab_yw = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four cd_xz = __builtin_shufflevector(c, d, 0, 4, 2, 6),
             cd_yw = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {
      __builtin_shufflevector(ab_xz, cd_xz, 0, 1, 4, 5), __builtin_shufflevector(ab_yw, cd_yw, 0, 1, 4, 5),
      __builtin_shufflevector(ab_xz, cd_xz, 2, 3, 6, 7), __builtin_shufflevector(ab_yw, cd_yw, 2, 3, 6, 7)};
}

/// Two numbers, one after the other in memory, from each of two places.
PACKBED_INLINE Four joined(const double& low, const double& high) {
  using Two = double __attribute__((vector_size(16)));
  return __builtin_shufflevector(reinterpret_cast<const Two&>(low), reinterpret_cast<const Two&>(high), 0, 1,
                                 2, 3);
}

/// The same from memory: half as many shuffles, as the halves of a vector can be loaded where they are
/// wanted.
PACKBED_INLINE FourQuads turned(const Quad& a, const Quad& b, const Quad& c, const Quad& d) {
  const Four ac_xy = joined(a.x, c.x), bd_xy = joined(b.x, d.x);
  const Four ac_zw = joined(a.z, c.z), bd_zw = joined(b.z, d.z);
  return {
      __builtin_shufflevector(ac_xy, bd_xy, 0, 4, 2, 6), __builtin_shufflevector(ac_xy, bd_xy, 1, 5, 3, 7),
      __builtin_shufflevector(ac_zw, bd_zw, 0, 4, 2, 6), __builtin_shufflevector(ac_zw, bd_zw, 1, 5, 3, 7)};
}

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
}  // namespace packbed
