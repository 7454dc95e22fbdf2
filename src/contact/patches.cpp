#include "contact/patches.hpp"

#include <algorithm>
#include <cmath>

#include "contact/deep_points.hpp"

namespace packbed {
namespace {

constexpr std::uint8_t kNone = kMostPatches;
// How much farther than the deep points others are listed, fractions of the size of the bodies: more, and
// each look costs more; less, and they are listed more often. It is doubled when a list has served for fewer
// looks than kFewLooks, and halved after kManyLooks.
constexpr double kLeastMargin = 0.002, kMostMargin = 0.06;
constexpr std::uint32_t kFewLooks = 12, kManyLooks = 100;

/// The points of one side of a pair that are deep, and the patch of each run of them. A run belongs where its
/// deepest point does.
struct Side {
  Sight sight;
  DeepPoints deep;
  std::vector<std::uint8_t> patch;

  PatchMark mark_of(const DeepPoints::Run& run) const {
    const std::size_t i = run.top;
    const Vec3 x(deep.x[i], deep.y[i], deep.z[i]), g(deep.gx[i], deep.gy[i], deep.gz[i]);
    return {sight.field_centre + sight.field_scale * (sight.field_turn * x),
            -sight.sign * (sight.field_turn * g).normalized()};
  }
  double rate(const DeepPoints::Run& run) const {
    return deep.weight[run.top] * depth_power_slope<kPointExponent>(deep.depth[run.top]);
  }
};

/// A mark in the frame of a side's field, and what belongs to it.
struct Seat {
  Vec3 centre, slope;
  double near2 = 0, far2 = 0;  // squared distances within which all belong, and those of like normal

  Seat() = default;
  Seat(const Sight& sight, const PatchMark& mark, double size)
      : centre(sight.field_turn.transpose() * (mark.centre - sight.field_centre) / sight.field_scale),
        slope(-sight.sign * (sight.field_turn.transpose() * mark.normal)) {
    const double far = size / sight.field_scale;
    far2 = far * far;
    near2 = kSideBySide * kSideBySide * far2;
  }
  double distance2(const DeepPoints& p, std::size_t i) const {
    return (Vec3(p.x[i], p.y[i], p.z[i]) - centre).squaredNorm();
  }
  bool holds(const DeepPoints& p, std::size_t i, double d2) const {
    const Vec3 g(p.gx[i], p.gy[i], p.gz[i]);
    const double along = g.dot(slope);
    return d2 < near2 || (d2 < far2 && along > 0 && along * along > kCone * kCone * g.squaredNorm());
  }
};

/// Whether all deep points of a side belong to one patch.
bool all_belong(const Side& side, const PatchMark& mark, double size) {
  const Seat seat(side.sight, mark, size);
  return std::all_of(side.deep.runs.begin(), side.deep.runs.end(), [&](const DeepPoints::Run& run) {
    return seat.holds(side.deep, run.top, seat.distance2(side.deep, run.top));
  });
}

/// Gives runs that have no patch yet to the nearest of the marks from `first` on that they belong to;
/// `anyway`: to the nearest, whether they belong to it or not.
void assign(Side& side, std::span<const PatchMark> marks, std::size_t first, double size, bool anyway) {
  std::array<Seat, kMostPatches> seats;
  for (std::size_t m = first; m < marks.size(); ++m) seats[m] = Seat(side.sight, marks[m], size);
  for (std::size_t r = 0; r < side.deep.runs.size(); ++r) {
    if (side.patch[r] != kNone) continue;
    const std::size_t top = side.deep.runs[r].top;
    double nearest2 = std::numeric_limits<double>::infinity();
    for (std::size_t m = first; m < marks.size(); ++m) {
      const double d2 = seats[m].distance2(side.deep, top);
      if (!(d2 < nearest2) || (!anyway && !seats[m].holds(side.deep, top, d2))) continue;
      nearest2 = d2;
      side.patch[r] = static_cast<std::uint8_t>(m);
    }
  }
}

/// The hardest pressed of the runs that have no patch yet. False when there are none.
bool find_seed(std::span<const Side> sides, PatchMark& seed) {
  double most = -1;
  for (const Side& side : sides)
    for (std::size_t r = 0; r < side.deep.runs.size(); ++r) {
      const DeepPoints::Run& run = side.deep.runs[r];
      if (side.patch[r] != kNone || side.rate(run) <= most) continue;
      most = side.rate(run);
      seed = side.mark_of(run);
    }
  return most >= 0;
}

/// Gives every run its patch: one of the marks given, or a new one round the hardest pressed of those left
/// over. Returns how many patches there may be.
std::size_t mark_patches(std::span<Side> sides, std::array<PatchMark, kMostPatches>& marks, std::size_t count,
                         double size) {
  for (Side& side : sides) {
    side.patch.assign(side.deep.runs.size(), kNone);
    assign(side, {marks.data(), count}, 0, size, false);
  }
  PatchMark seed;
  while (find_seed(sides, seed)) {
    const bool full = count == kMostPatches;
    if (!full) marks[count++] = seed;
    for (Side& side : sides) assign(side, {marks.data(), count}, full ? 0 : count - 1, size, full);
  }
  return count;
}

/// What a pair is summed up with.
struct Frame {
  Vec3 origin, centre_a, centre_b;  // world; centres from the origin
  double reference = 0, size = 0;   // [m]
};

void add_patch(PatchTouches& out, std::span<const Side> sides, const Frame& frame, std::uint8_t patch,
               bool known) {
  TouchSum<kPointExponent> sum(frame.origin);
  for (const Side& side : sides) add_deep(side.sight, side.deep, side.patch, patch, frame.origin, sum);
  if (sum.empty()) return;
  out.touch[out.count] = sum.finish(frame.reference, frame.centre_a, frame.centre_b);
  out.mark[out.count++] = known ? patch : kNone;
}

/// Shares of the pair's stiffness.
void share_out(PatchTouches& out) {
  double sum = 0;
  for (std::size_t k = 0; k < out.count; ++k) {
    sum += depth_power<kPointExponent>(out.touch[k].delta);
    out.depth = std::max(out.depth, out.touch[k].depth);
  }
  out.delta = out.count == 1 ? out.touch[0].delta : std::sqrt(std::sqrt(std::sqrt(sum)));
  for (std::size_t k = 0; k < out.count && out.count > 1; ++k) {
    const double part = out.touch[k].delta / out.delta, part2 = part * part;
    out.touch[k].share = part2 * part2 * part2;
  }
}

void sum_patches(PatchTouches& out, std::span<Side> sides, const Frame& frame,
                 std::span<const PatchMark> given) {
  std::array<PatchMark, kMostPatches> marks;
  std::copy(given.begin(), given.end(), marks.begin());
  std::size_t count = given.size();
  for (Side& side : sides) side.patch.clear();
  const bool one = count == 1 && std::all_of(sides.begin(), sides.end(), [&](const Side& side) {
                     return all_belong(side, marks[0], frame.size);
                   });
  if (!one) count = mark_patches(sides, marks, count, frame.size);
  for (std::size_t m = 0; m < count; ++m)
    add_patch(out, sides, frame, static_cast<std::uint8_t>(m), m < given.size());
  share_out(out);
}

bool any_deep(std::span<const Side> sides) {
  return std::any_of(sides.begin(), sides.end(), [](const Side& s) { return !s.deep.runs.empty(); });
}

/// Finds the deep points of all sides among those listed, listing them again when they are due. Whether there
/// are any.
bool look(std::span<Side> sides, double size, double cover, double travelled, NearPoints& near,
          PatchTouches& out) {
  out.count = 0;
  out.delta = out.depth = out.gap = 0;
  if (travelled >= near.until) {
    const double change = near.looks < kFewLooks ? 2.0 : near.looks > kManyLooks ? 0.5 : 1.0;
    const double margin = std::clamp(change * near.margin, kLeastMargin * size, kMostMargin * size);
    near.margin = margin;
    near.looks = 0;
    near.listed = travelled;
    double clear = list_near(sides[0].sight, margin, near.of[0]);
    // when a's points are so far from b that no part of its surface between them can be in b, none of b's
    // can be in a
    if (sides.size() == 2) {
      if (clear - cover > margin) {
        clear -= cover;
        near.of[1].drop();
      } else {
        clear = std::min(clear, list_near(sides[1].sight, margin, near.of[1]));
      }
    }
    near.until = travelled + clear;
  }
  ++near.looks;
  const double travel = travelled - near.listed;
  for (std::size_t s = 0; s < sides.size(); ++s) find_deep(sides[s].sight, travel, near.of[s], sides[s].deep);
  if (any_deep(sides)) return true;
  out.gap = near.until - travelled;
  for (const NearList& list : near.of) out.gap = std::min(out.gap, clear_of_all(list) - travel);
  return false;
}

}  // namespace

void touch_patches(const FieldPellet& a, const FieldPellet& b, double travelled,
                   std::span<const PatchMark> marks, NearPoints& near, PatchTouches& out) {
  thread_local std::array<Side, 2> sides;
  const FieldBody &of_a = *a.body, &of_b = *b.body;
  sides[0].sight = sight(a, of_b.field, b.pose, b.scale, 1);
  sides[1].sight = sight(b, of_a.field, a.pose, a.scale, -1);
  const double size = std::min(of_a.size * a.scale, of_b.size * b.scale);
  if (!look(sides, size, of_a.points.cover * a.scale, travelled, near, out)) return;
  const Vec3 origin = 0.5 * (a.pose.position + b.pose.position);
  sum_patches(out, sides, {origin, a.pose.position - origin, b.pose.position - origin, 2 * kPi * size, size},
              marks);
}

void touch_patches(const FieldPellet& a, const FieldWall& wall, double travelled,
                   std::span<const PatchMark> marks, NearPoints& near, PatchTouches& out) {
  thread_local std::array<Side, 1> sides;
  sides[0].sight = sight(a, wall.field, Pose(), 1, 1);  // the wall stays where it was read
  const double size = a.body->size * a.scale;
  if (!look(sides, size, 0, travelled, near, out)) return;
  const Vec3& origin = a.pose.position;
  sum_patches(out, sides, {origin, Vec3::Zero(), -origin, 2 * kPi * size, size}, marks);
}

}  // namespace packbed
