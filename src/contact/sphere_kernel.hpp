#pragma once
// The loops of sphere_pairs.hpp for any width. Included by one source a width, which may compile it for a
// processor of its own: so all of it is local to that source.
#include <type_traits>

#include "contact/sphere_pairs.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed {
namespace {

#define PACKBED_INLINE_LAMBDA __attribute__((always_inline))

/// Numbers of the lanes from `first` on.
using Numbers = const std::uint32_t*;

/// One after the other: two may name the same entry.
template <std::size_t N>
PACKBED_INLINE void add(const std::array<Four, N>& row, Numbers at, Quad* to) {
  for (std::size_t k = 0; k < N; ++k) four(to[at[k]]) += row[k];
}
/// Lane by lane, so that the order of the sums does not depend on the width.
template <std::size_t N>
PACKBED_INLINE void exchange(const std::array<Four, N>& row, Numbers to, Numbers from, Quad* at) {
  for (std::size_t k = 0; k < N; ++k) {
    four(at[to[k]]) += row[k];
    four(at[from[k]]) -= row[k];
  }
}
template <std::size_t N>
PACKBED_INLINE void add_both(const std::array<Four, N>& row_a, Numbers a, const std::array<Four, N>& row_b,
                             Numbers b, Quad* to) {
  for (std::size_t k = 0; k < N; ++k) {
    four(to[a[k]]) += row_a[k];
    four(to[b[k]]) += row_b[k];
  }
}

/// Blocks are walked part by part, kWidth<L> pairs each.
template <class L>
inline constexpr std::size_t kParts = kLanes / kWidth<L>;
template <class L>
using AllSums = std::array<SphereSums<L>, kParts<L>>;
/// The block that part p of a list is in, the part's number in it, and its first lane there.
template <class L>
struct Part {
  explicit Part(std::size_t p) : block(p / kParts<L>), number(p % kParts<L>), first(number * kWidth<L>) {}
  std::size_t block, number, first;
};

template <class L>
PACKBED_INLINE Springs<L> load(const SpringBlock& b, std::size_t first) {
  return {{part<L>(b.stretch[0], first), part<L>(b.stretch[1], first), part<L>(b.stretch[2], first)},
          part<L>(b.stiffness, first)};
}
template <class L>
PACKBED_INLINE void store(const Springs<L>& s, SpringBlock& b, std::size_t first) {
  part<L>(b.stretch[0], first) = s.stretch.x;
  part<L>(b.stretch[1], first) = s.stretch.y;
  part<L>(b.stretch[2], first) = s.stretch.z;
  part<L>(b.stiffness, first) = s.stiffness;
}
template <class L>
PACKBED_INLINE SphereState<L> recall(const SphereMemory& memory, std::size_t k, std::size_t first) {
  SphereState<L> had;
  had.drag = part<L>(memory.dash[k].drag, first);
  had.closing = part<L>(memory.dash[k].closing, first);
  had.touched = had.closing < DashBlock::kApart;
  if (memory.slip) had.slip = load<L>(memory.slip[k], first);
  if (memory.roll) had.roll = load<L>(memory.roll[k], first);
  return had;
}
template <class L>
PACKBED_INLINE void keep(const SphereState<L>& now, const SphereMemory& memory, std::size_t k,
                         std::size_t first) {
  part<L>(memory.dash[k].drag, first) = now.drag;
  part<L>(memory.dash[k].closing, first) = now.touched ? now.closing : all<L>(DashBlock::kApart);
  if (memory.slip) store(now.slip, memory.slip[k], first);
  if (memory.roll) store(now.roll, memory.roll[k], first);
}
template <class L>
PACKBED_INLINE AllSums<L> load(const SphereTally& t) {
  AllSums<L> sums;
  for (std::size_t p = 0; p < kParts<L>; ++p) {
    const std::size_t first = p * kWidth<L>;
    sums[p] = {part<L>(t.damped, first), part<L>(t.rubbed, first), part<L>(t.deepest, first),
               part<L>(t.touches, first), part<L>(t.deep, first)};
  }
  return sums;
}
template <class L>
PACKBED_INLINE void store(const AllSums<L>& sums, SphereTally& t) {
  for (std::size_t p = 0; p < kParts<L>; ++p) {
    const std::size_t first = p * kWidth<L>;
    part<L>(t.damped, first) = sums[p].damped;
    part<L>(t.rubbed, first) = sums[p].rubbed;
    part<L>(t.deepest, first) = sums[p].deepest;
    part<L>(t.touches, first) = sums[p].touches;
    part<L>(t.deep, first) = sums[p].deep;
  }
}

template <class L>
PACKBED_INLINE void describe(const SphereLaw& law, const SphereTouch<L>& t, const SphereForce<L>& f,
                             const SphereState<L>& now, SphereContact* contacts) {
  const L delta = t.touches ? t.delta : L{};
  const L elastic = elastic_share(law) * elastic_of(law, law.hertz, t.radius, delta).force * delta +
                    stored_in(now.slip) + stored_in(now.roll);
  const LaneRows<L> row = rows(f.force, delta);
  for (std::size_t k = 0; k < kWidth<L>; ++k) {
    four(contacts[k].force) = row[k];
    contacts[k].elastic = elastic[k];
  }
}

/// The forces of part p, and what it remembers of them; false when they were only to be described.
template <class Form, class L>
PACKBED_INLINE bool find_force(Form form, const SphereWork& work, std::size_t p, const SphereTouch<L>& t,
                               SphereState<L>& state, AllSums<L>& sums, SphereForce<L>& f) {
  if (work.contacts) state.touched = Flags<L>{};  // nothing has gone before
  const Part<L> at(p);
  f = resolve(form, work.law, t, work.step, state, sums[at.number]);
  if (work.contacts)
    describe(work.law, t, f, state, work.contacts + kWidth<L> * p);
  else
    keep(state, work.memory, at.block, at.first);
  return !work.contacts;
}

/// Normal of a wall where the sphere is, and its distance.
template <class L>
struct WallSide {
  LaneVec<L> normal;
  L distance;
};
template <class L>
PACKBED_INLINE WallSide<L> side_of(const LaneQuads<L>& wall, const LaneVec<L>& x) {
  const LaneVec<L> flat = vec(wall);
  const Flags<L> round = dot(flat, flat) < 0.5;
  if (!any(round)) return {flat, dot(flat, x) - wall.w};
  const L across = root(x.x * x.x + x.y * x.y), inverse = 1.0 / (across > 0.0 ? across : all<L>(1.0));
  const LaneVec<L> inwards{-x.x * inverse, -x.y * inverse, L{}};
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

/// side_at(part, x): the wall beside each of the spheres of a part if they stood at x.
template <class L, class Form, class SideAt>
PACKBED_INLINE void touch_sides(Form form, const SphereWork& work, const SideAt& side_at) {
  const auto& [law, view, step, blocks, memory, tally, contacts] = work;
  AllSums<L> sums = load<L>(tally);
  for (std::size_t p = 0; p < kParts<L> * blocks.size(); ++p) {
    const Part<L> at(p);
    const Numbers a = blocks[at.block].a.data() + at.first;
    const LaneQuads<L> place = gather<L>(view.place, a);
    const WallSide<L> side = side_at(p, vec(place));
    SphereTouch<L> t;
    t.touches = side.distance < place.w;
    SphereState<L> state = recall<L>(memory, at.block, at.first);
    if (!any(t.touches | state.touched) && !contacts) continue;
    const LaneQuads<L> velocity = gather<L>(view.velocity, a);
    t.normal = side.normal;
    t.delta = place.w - side.distance;
    t.radius = place.w;
    t.thickness = 2.0 * place.w;
    t.mass = 1.0 / (velocity.w > 0.0 ? velocity.w : all<L>(1.0));
    t.mid = vec(velocity);
    const L lever = 1.0 - 0.5 * t.delta / place.w;
    if constexpr (Form::friction) {
      t.normal_mid = side_at(p, vec(place) - (0.5 * step) * t.mid).normal;
      t.rolling = vec(gather<L>(view.spin, a));
      t.turning = (lever * place.w) * t.rolling;
    }
    SphereForce<L> f;
    if (!find_force(form, work, p, t, state, sums, f)) continue;
    add(rows(f.force, L{}), a, view.force);
    if constexpr (!Form::friction) continue;
    LaneVec<L> twist = lever * f.moment;
    if constexpr (Form::rolling) twist = twist - (1.0 / place.w) * f.rolling;
    add(rows(twist, L{}), a, view.twist);
  }
  if (!contacts) store<L>(sums, tally);
}

/// Asks for what the pairs of a block a little further on will read: neighbours in space that stand elsewhere
/// in memory are waited for otherwise.
template <class Form>
PACKBED_INLINE void fetch_ahead(Form, const SphereView& view, std::span<const PairBlock> blocks,
                                std::size_t k) {
  constexpr std::size_t kAhead = 2;
  if (k + kAhead >= blocks.size()) return;
  for (const std::uint32_t b : blocks[k + kAhead].b) {
    __builtin_prefetch(view.place + b);
    __builtin_prefetch(view.velocity + b);
    if constexpr (Form::friction) __builtin_prefetch(view.spin + b);
  }
}

template <class L, class Form>
PACKBED_INLINE void touch_pairs(Form form, const SphereWork& work) {
  const auto& [law, view, step, blocks, memory, tally, contacts] = work;
  AllSums<L> sums = load<L>(tally);
  for (std::size_t p = 0; p < kParts<L> * blocks.size(); ++p) {
    const Part<L> at(p);
    if (at.first == 0) fetch_ahead(form, view, blocks, at.block);
    const PairBlock& block = blocks[at.block];
    const Numbers a = block.a.data() + at.first, b = block.b.data() + at.first,
                  to = block.to.data() + at.first;
    const LaneQuads<L> place_a = gather<L>(view.place, a), place_b = gather<L>(view.place, b);
    const LaneVec<L> apart = vec(place_a) - vec(place_b);
    const L distance2 = dot(apart, apart), reach = place_a.w + place_b.w;
    SphereTouch<L> t;
    t.touches = (distance2 < reach * reach) & (distance2 > 0.0);
    SphereState<L> state = recall<L>(memory, at.block, at.first);
    if (!any(t.touches | state.touched) && !contacts) continue;
    const LaneQuads<L> velocity_a = gather<L>(view.velocity, a), velocity_b = gather<L>(view.velocity, b);
    const L distance = root(distance2 > 0.0 ? distance2 : all<L>(1.0)),
            lightness = velocity_a.w + velocity_b.w;
    // 1 / distance, 1 / reach, R* and m* by one division
    const L scale = reach * lightness, shared = 1.0 / (distance * (scale > 0.0 ? scale : all<L>(1.0)));
    const L inverse = scale * shared, share = distance * shared;
    t.normal = inverse * apart;
    t.delta = reach - distance;
    t.radius = place_a.w * place_b.w * lightness * share;
    t.mass = reach * share;
    t.thickness = 2.0 * smaller(place_a.w, place_b.w);
    t.mid = vec(velocity_a) - vec(velocity_b);
    // the point of contact parts the line between the centres as the radii do
    const L lever = distance * lightness * share;
    if constexpr (Form::friction) {
      // the normal half a step ago, unit to the fourth order of the angle that it has turned since
      const LaneVec<L> back = (0.5 * step * inverse) * (t.mid - dot(t.mid, t.normal) * t.normal);
      t.normal_mid = (1.0 - 0.5 * dot(back, back)) * (t.normal - back);
      const LaneVec<L> spin_a = vec(gather<L>(view.spin, a)), spin_b = vec(gather<L>(view.spin, b));
      t.turning = lever * (place_a.w * spin_a + place_b.w * spin_b);
      t.rolling = spin_a - spin_b;
    }
    SphereForce<L> f;
    if (!find_force(form, work, p, t, state, sums, f)) continue;
    exchange(rows(f.force, L{}), a, to, view.force);
    if constexpr (!Form::friction) continue;
    const LaneVec<L> moment = lever * f.moment;
    if constexpr (Form::rolling) {
      add_both(rows(moment - (1.0 / place_a.w) * f.rolling, L{}), a,
               rows(moment + (1.0 / place_b.w) * f.rolling, L{}), to, view.twist);
    } else {
      const LaneRows<L> twist = rows(moment, L{});
      add_both(twist, a, twist, to, view.twist);
    }
  }
  if (!contacts) store<L>(sums, tally);
}

template <class L>
PACKBED_INLINE void spheres(const SphereWork& work) {
  by_form(work.law, [&](auto form) PACKBED_INLINE_LAMBDA { touch_pairs<L>(form, work); });
}

template <class L>
PACKBED_INLINE void walls(const SphereWork& work, std::span<const SphereWall> of) {
  const auto side_at = [&](std::size_t p, const LaneVec<L>& x) PACKBED_INLINE_LAMBDA {
    const Part<L> at(p);
    return side_of(gather<L>(of.data(), work.blocks[at.block].b.data() + at.first), x);
  };
  by_form(work.law, [&](auto form) PACKBED_INLINE_LAMBDA { touch_sides<L>(form, work, side_at); });
}

template <class L>
PACKBED_INLINE void given_walls(const SphereWork& work, std::span<const Quad> sides) {
  static constexpr LaneNumbers kInOrder{0, 1, 2, 3, 4, 5, 6, 7};
  const auto side_at = [&](std::size_t p, const LaneVec<L>&) PACKBED_INLINE_LAMBDA {
    const LaneQuads<L> q = gather<L>(sides.data() + kWidth<L> * p, kInOrder.data());
    return WallSide<L>{vec(q), q.w};
  };
  by_form(work.law, [&](auto form) PACKBED_INLINE_LAMBDA { touch_sides<L>(form, work, side_at); });
}

}  // namespace
}  // namespace packbed
