#include "contact/sphere_pairs.hpp"

#include <type_traits>

#include "math/simd.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed {
namespace {

#define PACKBED_INLINE_LAMBDA __attribute__((always_inline))

using Lane = std::array<std::uint32_t, 4>;

PACKBED_INLINE FourQuads gather(const Quad* from, const Lane& at) {
  return turned(from[at[0]], from[at[1]], from[at[2]], from[at[3]]);
}
PACKBED_INLINE FourVec vec(const FourQuads& q) {
  return {q.x, q.y, q.z};
}
using Rows = std::array<Four, 4>;
PACKBED_INLINE Rows rows(const FourVec& v, const Four& w) {
  const FourQuads q = turned(v.x, v.y, v.z, w);
  return {q.x, q.y, q.z, q.w};
}
/// One after the other: two may name the same entry.
PACKBED_INLINE void add(const Rows& row, const Lane& at, Quad* to) {
  for (std::size_t k = 0; k < 4; ++k) four(to[at[k]]) += row[k];
}
PACKBED_INLINE void take(const Rows& row, const Lane& at, Quad* from) {
  for (std::size_t k = 0; k < 4; ++k) four(from[at[k]]) -= row[k];
}

PACKBED_INLINE Springs load(const SpringBlock& b) {
  return {{four(b.stretch[0]), four(b.stretch[1]), four(b.stretch[2])}, four(b.stiffness)};
}
PACKBED_INLINE void store(const Springs& s, SpringBlock& b) {
  four(b.stretch[0]) = s.stretch.x;
  four(b.stretch[1]) = s.stretch.y;
  four(b.stretch[2]) = s.stretch.z;
  four(b.stiffness) = s.stiffness;
}
PACKBED_INLINE SphereState recall(const SphereMemory& memory, std::size_t k) {
  SphereState had;
  had.drag = four(memory.dash[k].drag);
  had.closing = four(memory.dash[k].closing);
  had.touched = had.closing < DashBlock::kApart;
  if (memory.slip) had.slip = load(memory.slip[k]);
  if (memory.roll) had.roll = load(memory.roll[k]);
  return had;
}
PACKBED_INLINE void keep(const SphereState& now, const SphereMemory& memory, std::size_t k) {
  four(memory.dash[k].drag) = now.drag;
  four(memory.dash[k].closing) = now.touched ? now.closing : four(DashBlock::kApart);
  if (memory.slip) store(now.slip, memory.slip[k]);
  if (memory.roll) store(now.roll, memory.roll[k]);
}

PACKBED_INLINE void describe(const SphereLaw& law, const SphereTouch& t, const SphereForce& f,
                             const SphereState& now, SphereContact* contacts) {
  const Four delta = t.touches ? t.delta : Four{};
  const Four elastic = elastic_share(law) * elastic_of(law, law.hertz, t.radius, delta).force * delta +
                       stored_in(now.slip) + stored_in(now.roll);
  const Rows row = rows(f.force, delta);
  for (std::size_t k = 0; k < 4; ++k) {
    four(contacts[k].force) = row[k];
    contacts[k].elastic = elastic[static_cast<int>(k)];
  }
}

/// Normal of a wall where the sphere is, and its distance.
struct WallSide {
  FourVec normal;
  Four distance;
};
PACKBED_INLINE WallSide side_of(const FourQuads& wall, const FourVec& x) {
  const FourVec flat = vec(wall);
  const FourFlags round = dot(flat, flat) < 0.5;
  if (!any(round)) return {flat, dot(flat, x) - wall.w};
  const Four across = root(x.x * x.x + x.y * x.y), inverse = 1.0 / (across > 0.0 ? across : four(1.0));
  const FourVec inwards{-x.x * inverse, -x.y * inverse, Four{}};
  return {choose(round, inwards, flat), round ? wall.w - across : dot(flat, x) - wall.w};
}

/// Calls run(form) with the form of the law.
template <class Run>
PACKBED_INLINE void by_form(const SphereLaw& law, const Run& run) {
  const auto rest = [&](auto hertz) PACKBED_INLINE_LAMBDA {
    constexpr bool kHertz = decltype(hertz)::value;
    if (!(law.friction > 0))
      run(SphereForm<kHertz, false, false>{});
    else if (law.rolling_friction > 0)
      run(SphereForm<kHertz, true, true>{});
    else
      run(SphereForm<kHertz, true, false>{});
  };
  law.hertz ? rest(std::true_type{}) : rest(std::false_type{});
}

/// side_at(block, x): the wall beside each of four spheres if they stood at x.
template <class Form, class SideAt>
PACKBED_INLINE void touch_sides(Form form, const SphereLaw& law, const SphereView& view, double step,
                                std::span<const PairBlock> blocks, const SphereMemory& memory,
                                SphereTally& tally, SphereContact* contacts, const SideAt& side_at) {
  SphereTally sums = tally;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Lane& a = blocks[k].a;
    const FourQuads place = gather(view.place, a);
    const WallSide side = side_at(k, vec(place));
    SphereTouch t;
    t.touches = side.distance < place.w;
    SphereState state = recall(memory, k);
    if (!any(t.touches | state.touched) && !contacts) continue;
    const FourQuads velocity = gather(view.velocity, a);
    t.normal = side.normal;
    t.delta = place.w - side.distance;
    t.radius = place.w;
    t.thickness = 2.0 * place.w;
    t.mass = 1.0 / (velocity.w > 0.0 ? velocity.w : four(1.0));
    t.mid = vec(velocity);
    const Four lever = 1.0 - 0.5 * t.delta / place.w;
    if constexpr (Form::friction) {
      t.normal_mid = side_at(k, vec(place) - (0.5 * step) * t.mid).normal;
      t.rolling = vec(gather(view.spin, a));
      t.turning = (lever * place.w) * t.rolling;
    }
    if (contacts) state.touched = FourFlags{};  // nothing has gone before
    const SphereForce f = resolve(form, law, t, step, state, sums);
    if (contacts) {
      describe(law, t, f, state, contacts + 4 * k);
      continue;
    }
    keep(state, memory, k);
    add(rows(f.force, Four{}), a, view.force);
    if constexpr (!Form::friction) continue;
    FourVec twist = lever * f.moment;
    if constexpr (Form::rolling) twist = twist - (1.0 / place.w) * f.rolling;
    add(rows(twist, Four{}), a, view.twist);
  }
  if (!contacts) tally = sums;
}

template <class Form>
PACKBED_INLINE void touch_pairs(Form form, const SphereLaw& law, const SphereView& view, double step,
                                std::span<const PairBlock> blocks, const SphereMemory& memory,
                                SphereTally& tally, SphereContact* contacts) {
  SphereTally sums = tally;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Lane &a = blocks[k].a, &b = blocks[k].b, &to = blocks[k].to;
    const FourQuads place_a = gather(view.place, a), place_b = gather(view.place, b);
    const FourVec apart = vec(place_a) - vec(place_b);
    const Four distance2 = dot(apart, apart), reach = place_a.w + place_b.w;
    SphereTouch t;
    t.touches = (distance2 < reach * reach) & (distance2 > 0.0);
    SphereState state = recall(memory, k);
    if (!any(t.touches | state.touched) && !contacts) continue;
    const FourQuads velocity_a = gather(view.velocity, a), velocity_b = gather(view.velocity, b);
    const Four distance = root(distance2 > 0.0 ? distance2 : four(1.0)),
               lightness = velocity_a.w + velocity_b.w;
    // 1 / distance, 1 / reach, R* and m* by one division
    const Four scale = reach * lightness, shared = 1.0 / (distance * (scale > 0.0 ? scale : four(1.0)));
    const Four inverse = scale * shared, share = distance * shared;
    t.normal = inverse * apart;
    t.delta = reach - distance;
    t.radius = place_a.w * place_b.w * lightness * share;
    t.mass = reach * share;
    t.thickness = 2.0 * smaller(place_a.w, place_b.w);
    t.mid = vec(velocity_a) - vec(velocity_b);
    // the point of contact parts the line between the centres as the radii do
    const Four lever = distance * lightness * share;
    if constexpr (Form::friction) {
      // the normal half a step ago, unit to the fourth order of the angle that it has turned since
      const FourVec back = (0.5 * step * inverse) * (t.mid - dot(t.mid, t.normal) * t.normal);
      t.normal_mid = (1.0 - 0.5 * dot(back, back)) * (t.normal - back);
      const FourVec spin_a = vec(gather(view.spin, a)), spin_b = vec(gather(view.spin, b));
      t.turning = lever * (place_a.w * spin_a + place_b.w * spin_b);
      t.rolling = spin_a - spin_b;
    }
    if (contacts) state.touched = FourFlags{};  // nothing has gone before
    const SphereForce f = resolve(form, law, t, step, state, sums);
    if (contacts) {
      describe(law, t, f, state, contacts + 4 * k);
      continue;
    }
    keep(state, memory, k);
    const Rows force = rows(f.force, Four{});
    add(force, a, view.force);
    take(force, to, view.force);
    if constexpr (!Form::friction) continue;
    const FourVec moment = lever * f.moment;
    if constexpr (Form::rolling) {
      add(rows(moment - (1.0 / place_a.w) * f.rolling, Four{}), a, view.twist);
      add(rows(moment + (1.0 / place_b.w) * f.rolling, Four{}), to, view.twist);
    } else {
      const Rows twist = rows(moment, Four{});
      add(twist, a, view.twist);
      add(twist, to, view.twist);
    }
  }
  if (!contacts) tally = sums;
}

}  // namespace

PACKBED_WIDE void touch_spheres(const SphereLaw& law, const SphereView& view, double step,
                                std::span<const PairBlock> blocks, const SphereMemory& memory,
                                SphereTally& tally, SphereContact* contacts) {
  by_form(law, [&](auto form) PACKBED_INLINE_LAMBDA {
    touch_pairs(form, law, view, step, blocks, memory, tally, contacts);
  });
}

PACKBED_WIDE void touch_walls(const SphereLaw& law, const SphereView& view, double step,
                              std::span<const SphereWall> walls, std::span<const PairBlock> blocks,
                              const SphereMemory& memory, SphereTally& tally, SphereContact* contacts) {
  const auto side_at = [&](std::size_t k, const FourVec& x)
                           PACKBED_INLINE_LAMBDA { return side_of(gather(walls.data(), blocks[k].b), x); };
  by_form(law, [&](auto form) PACKBED_INLINE_LAMBDA {
    touch_sides(form, law, view, step, blocks, memory, tally, contacts, side_at);
  });
}

PACKBED_WIDE void touch_given_walls(const SphereLaw& law, const SphereView& view, double step,
                                    std::span<const Quad> sides, std::span<const PairBlock> blocks,
                                    const SphereMemory& memory, SphereTally& tally, SphereContact* contacts) {
  const auto side_at = [&](std::size_t k, const FourVec&) PACKBED_INLINE_LAMBDA {
    const FourQuads q = gather(sides.data() + 4 * k, {0, 1, 2, 3});
    return WallSide{vec(q), q.w};
  };
  by_form(law, [&](auto form) PACKBED_INLINE_LAMBDA {
    touch_sides(form, law, view, step, blocks, memory, tally, contacts, side_at);
  });
}

}  // namespace packbed
