#include "contact/sphere_pairs.hpp"

#include <array>

#include "math/simd.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed {
namespace {

using Lane = std::array<std::uint32_t, 4>;
#define PACKBED_INLINE_LAMBDA __attribute__((always_inline))

PACKBED_INLINE FourQuads gather(const Quad* from, const Lane& at) {
  return turned(four(from[at[0]]), four(from[at[1]]), four(from[at[2]]), four(from[at[3]]));
}
PACKBED_INLINE FourVec vec(const FourQuads& q) {
  return {q.x, q.y, q.z};
}
PACKBED_INLINE FourQuads rows(const FourVec& v, const Four& w) {
  return turned(v.x, v.y, v.z, w);
}

/// Four contacts from number `first` on; lanes beyond the last repeat it and do not count.
struct Block {
  std::size_t first, count;  // count: 1 to 4
  FourFlags used;
};
PACKBED_INLINE Block block_at(std::size_t first, std::size_t n) {
  const std::size_t count = n - first < 4 ? n - first : 4;
  const long k = static_cast<long>(count);
  return {first, count, FourFlags{0, 1, 2, 3} < FourFlags{k, k, k, k}};
}

PACKBED_INLINE FourSprings load(const Quad* springs, const Block& b) {
  const Lane at{0, b.count > 1 ? 1U : 0U, b.count > 2 ? 2U : 0U, b.count > 3 ? 3U : 0U};
  const FourQuads q = gather(springs + b.first, at);
  return {vec(q), b.used ? q.w : Four{}};
}
PACKBED_INLINE void store(const FourSprings& s, const Block& b, Quad* springs) {
  const FourQuads q = rows(s.stretch, s.stiffness);
  four(springs[b.first]) = q.x;
  if (b.count > 1) four(springs[b.first + 1]) = q.y;
  if (b.count > 2) four(springs[b.first + 2]) = q.z;
  if (b.count > 3) four(springs[b.first + 3]) = q.w;
}
struct Remembered {
  FourSprings slip, roll;
  Four drag{};
};
PACKBED_INLINE Remembered recall(const SphereMemory& memory, const Block& b) {
  Remembered had;
  if (memory.slip) had.slip = load(memory.slip, b);
  if (memory.roll) had.roll = load(memory.roll, b);
  for (std::size_t k = 0; k < b.count; ++k) had.drag[k] = memory.drag[b.first + k];
  return had;
}
PACKBED_INLINE void keep(const Remembered& now, const Block& b, const SphereMemory& memory) {
  if (memory.slip) store(now.slip, b, memory.slip);
  if (memory.roll) store(now.roll, b, memory.roll);
  for (std::size_t k = 0; k < b.count; ++k) memory.drag[b.first + k] = now.drag[k];
}
PACKBED_INLINE bool empty(const Remembered& had) {
  return !any((had.slip.stiffness > 0.0) | (had.drag != 0.0));
}

/// Adds the rows of q to the entries that `at` names, one after the other: two may be the same.
PACKBED_INLINE void add(const FourQuads& q, const Lane& at, std::size_t count, Quad* to) {
  four(to[at[0]]) += q.x;
  if (count > 1) four(to[at[1]]) += q.y;
  if (count > 2) four(to[at[2]]) += q.z;
  if (count > 3) four(to[at[3]]) += q.w;
}
PACKBED_INLINE FourVec minus(const FourVec& v) {
  return {-v.x, -v.y, -v.z};
}

PACKBED_INLINE void describe(const SphereLaw& law, const SphereTouch& t, const SphereForce& f,
                             const Remembered& now, const Block& b, SphereContact* contacts) {
  const Four delta = t.touches ? t.delta : Four{};
  const Four elastic = elastic_share(law) * elastic_of(law, t.radius, delta).force * delta +
                       stored_in(now.slip) + stored_in(now.roll);
  const FourQuads q = rows(f.force, delta);
  const std::array<Four, 4> row{q.x, q.y, q.z, q.w};
  for (std::size_t k = 0; k < b.count; ++k) {
    four(contacts[b.first + k].force) = row[k];
    contacts[b.first + k].elastic = elastic[static_cast<int>(k)];
  }
}

/// Normal of a wall where the sphere is, and its distance.
struct WallSide {
  FourVec normal;
  Four distance;
};
PACKBED_INLINE WallSide side_of(const FourQuads& wall, const FourVec& x) {
  const FourVec flat = vec(wall);
  const Four across = root(x.x * x.x + x.y * x.y), inverse = 1.0 / (across > 0.0 ? across : four(1.0));
  const FourVec inwards{-x.x * inverse, -x.y * inverse, Four{}};
  const FourFlags round = dot(flat, flat) < 0.5;
  return {choose(round, inwards, flat), round ? wall.w - across : dot(flat, x) - wall.w};
}

/// side_at(block, x): the wall beside each of four spheres if they stood at x.
template <class SideAt>
PACKBED_INLINE void touch_sides(const SphereLaw& law, const SphereView& view, double step,
                                std::span<const SphereWallPair> pairs, const SphereMemory& memory,
                                SphereTally& tally, SphereContact* contacts, const SideAt& side_at) {
  SphereTally sums = tally;
  for (std::size_t first = 0; first < pairs.size(); first += 4) {
    const Block block = block_at(first, pairs.size());
    Lane a;
    for (std::size_t k = 0; k < 4; ++k) {
      const SphereWallPair& p = pairs[first + (k < block.count ? k : 0)];
      a[k] = p.a;
    }
    const FourQuads place = gather(view.place, a);
    const WallSide side = side_at(block, vec(place));
    SphereTouch t;
    t.touches = block.used & (side.distance < place.w);
    Remembered had = recall(memory, block);
    if (!any(t.touches) && empty(had) && !contacts) continue;
    t.normal = side.normal;
    t.delta = place.w - side.distance;
    t.radius = place.w;
    t.thickness = 2.0 * place.w;
    const FourQuads velocity = gather(view.velocity, a);
    t.mass = 1.0 / velocity.w;
    t.ahead = vec(gather(view.ahead, a));
    t.mid = vec(velocity);
    const Four arm = place.w - 0.5 * t.delta;
    if (law.friction > 0) {
      t.normal_mid = side_at(block, vec(place) - (0.5 * step) * t.mid).normal;
      t.rolling = vec(gather(view.spin, a));
      t.turning = arm * t.rolling;
    }
    const SphereForce f = resolve(law, t, step, had.slip, had.roll, had.drag, sums);
    if (contacts) {
      describe(law, t, f, had, block, contacts);
      continue;
    }
    add(rows(f.force, Four{}), a, block.count, view.force);
    keep(had, block, memory);
    if (!(law.friction > 0)) continue;
    add(rows(f.rolling - arm * f.moment, Four{}), a, block.count, view.torque);
  }
  if (!contacts) tally = sums;
}

}  // namespace

PACKBED_WIDE void touch_spheres(const SphereLaw& law, const SphereView& view, double step,
                                std::span<const SpherePair> pairs, const SphereMemory& memory,
                                SphereTally& tally, SphereContact* contacts) {
  SphereTally sums = tally;
  for (std::size_t first = 0; first < pairs.size(); first += 4) {
    const Block block = block_at(first, pairs.size());
    Lane a, b, to;
    for (std::size_t k = 0; k < 4; ++k) {
      const SpherePair& p = pairs[first + (k < block.count ? k : 0)];
      a[k] = p.a, b[k] = p.b, to[k] = p.to;
    }
    const FourQuads place_a = gather(view.place, a), place_b = gather(view.place, b);
    const FourVec apart = vec(place_a) - vec(place_b);
    const Four distance2 = dot(apart, apart), reach = place_a.w + place_b.w;
    SphereTouch t;
    t.touches = block.used & (distance2 < reach * reach) & (distance2 > 0.0);
    Remembered had = recall(memory, block);
    if (!any(t.touches) && empty(had) && !contacts) continue;
    const FourQuads velocity_a = gather(view.velocity, a), velocity_b = gather(view.velocity, b);
    const Four distance = root(distance2 > 0.0 ? distance2 : four(1.0)),
               lightness = velocity_a.w + velocity_b.w;
    // 1 / distance, R* and m* by one division
    const Four scale = reach * lightness, shared = 1.0 / (distance * scale), inverse = scale * shared;
    const Four share = distance * shared;
    t.normal = inverse * apart;
    t.delta = reach - distance;
    t.radius = place_a.w * place_b.w * lightness * share;
    t.mass = reach * share;
    t.thickness = 2.0 * smaller(place_a.w, place_b.w);
    t.ahead = vec(gather(view.ahead, a)) - vec(gather(view.ahead, b));
    t.mid = vec(velocity_a) - vec(velocity_b);
    const Four arm_a = place_a.w - 0.5 * t.delta, arm_b = place_b.w - 0.5 * t.delta;
    if (law.friction > 0) {
      // the normal half a step ago, unit to the fourth order of the angle that it has turned since
      const FourVec back = (0.5 * step * inverse) * (t.mid - dot(t.mid, t.normal) * t.normal);
      t.normal_mid = (1.0 - 0.5 * dot(back, back)) * (t.normal - back);
      const FourVec spin_a = vec(gather(view.spin, a)), spin_b = vec(gather(view.spin, b));
      t.turning = arm_a * spin_a + arm_b * spin_b;
      t.rolling = spin_a - spin_b;
    }
    const SphereForce f = resolve(law, t, step, had.slip, had.roll, had.drag, sums);
    if (contacts) {
      describe(law, t, f, had, block, contacts);
      continue;
    }
    add(rows(f.force, Four{}), a, block.count, view.force);
    add(rows(minus(f.force), Four{}), to, block.count, view.force);
    keep(had, block, memory);
    if (!(law.friction > 0)) continue;
    add(rows(f.rolling - arm_a * f.moment, Four{}), a, block.count, view.torque);
    add(rows(minus(f.rolling + arm_b * f.moment), Four{}), to, block.count, view.torque);
  }
  if (!contacts) tally = sums;
}

PACKBED_WIDE void touch_walls(const SphereLaw& law, const SphereView& view, double step,
                              std::span<const SphereWall> walls, std::span<const SphereWallPair> pairs,
                              const SphereMemory& memory, SphereTally& tally, SphereContact* contacts) {
  touch_sides(law, view, step, pairs, memory, tally, contacts,
              [&](const Block& block, const FourVec& x) PACKBED_INLINE_LAMBDA {
                Lane w;
                for (std::size_t k = 0; k < 4; ++k)
                  w[k] = pairs[block.first + (k < block.count ? k : 0)].wall;
                return side_of(gather(walls.data(), w), x);
              });
}

PACKBED_WIDE void touch_given_walls(const SphereLaw& law, const SphereView& view, double step,
                                    std::span<const Quad> sides, std::span<const SphereWallPair> pairs,
                                    const SphereMemory& memory, SphereTally& tally, SphereContact* contacts) {
  touch_sides(law, view, step, pairs, memory, tally, contacts,
              [&](const Block& block, const FourVec&) PACKBED_INLINE_LAMBDA {
                Lane at;
                for (std::size_t k = 0; k < 4; ++k)
                  at[k] = static_cast<std::uint32_t>(k < block.count ? k : 0);
                const FourQuads q = gather(sides.data() + block.first, at);
                return WallSide{vec(q), q.w};
              });
}

}  // namespace packbed
