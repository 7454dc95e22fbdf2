#include "packers/mesh/patches.hpp"

#include <algorithm>
#include <cmath>

#include "packers/mesh/kernels.hpp"
#include "packers/mesh/push.hpp"

namespace packbed::mesh {
namespace {

FieldPellet pellet(const Model& model, const Bodies& bodies, std::uint32_t i) {
  return {model.kinds[bodies.kind[i]].field.get(), {bodies.position[i], bodies.rotation[i]}, bodies.scale[i]};
}

/// A patch is gone, and what its springs of friction held is lost.
void release(const PatchRecord& patch, PairRecord& record) {
  record.rubbed += patch.stretched;
}

/// Two patches that have come to face the same way side by side are one; the harder pressed one stays.
void join(PatchRecords& patches, double size, PairRecord& record) {
  for (std::size_t i = 0; i < patches.count; ++i)
    for (std::size_t j = patches.count - 1; j > i; --j) {
      PatchRecord &p = patches.patch[i], &q = patches.patch[j];
      const double apart = (p.mark.centre - q.mark.centre).norm();
      const bool side_by_side = apart < 0.25 * kSideBySide * size;
      if (!side_by_side && (p.mark.normal.dot(q.mark.normal) < kJoin || apart > 0.25 * size)) continue;
      if (q.delta > p.delta) std::swap(p, q);
      release(q, record);
      record.elastic -= q.stretched;
      std::copy(patches.patch.begin() + static_cast<std::ptrdiff_t>(j) + 1,
                patches.patch.begin() + static_cast<std::ptrdiff_t>(patches.count),
                patches.patch.begin() + static_cast<std::ptrdiff_t>(j));
      --patches.count;
    }
}

/// Bounds of the distance from what a pair is looked at for: bounding spheres and plain walls.
double far_apart(const Model& model, const Bodies& bodies, const BodyPair& pair) {
  const auto [a, b] = pair;
  const Vec3& x = bodies.position[a];
  const double reach = bodies.bounding_radius[a];
  if (b == kFloor) return x.z() - reach;
  if (b == kWall) return model.container.radius - std::hypot(x.x(), x.y()) - reach;
  if (b == kSolid) return 0;
  if (is_side(b)) return side_of(model.container, b - kSide).distance(x) - reach;
  return (x - bodies.position[b]).norm() - reach - bodies.bounding_radius[b];
}

bool same_patches(const PatchTouches& found, std::size_t known) {
  bool same = found.count == known;
  for (std::size_t k = 0; k < found.count; ++k) same &= found.mark[k] == k;
  return same;
}

/// Puts the records in the order of the patches found; new ones are blank, those that are gone released.
void carry_on(const PatchTouches& found, PatchRecords& patches, PairRecord& record) {
  const PatchRecords before = patches;
  std::array<bool, kMostPatches> goes_on{};
  for (std::size_t k = 0; k < found.count; ++k) {
    const std::size_t mark = found.mark[k];
    patches.patch[k] = mark < before.count ? before.patch[mark] : PatchRecord{};
    if (mark < before.count) goes_on[mark] = true;
  }
  patches.count = found.count;
  for (std::size_t k = 0; k < before.count; ++k)
    if (!goes_on[k]) release(before.patch[k], record);
}

}  // namespace

void look_at_patches(const Model& model, State& state, std::uint32_t p, double travelled) {
  const auto [a, b] = state.pairs.pair[p];
  PairRecord& record = state.pairs.record[p];
  PatchRecords& patches = state.pairs.patches[p];
  NearPoints& near = state.pairs.near[p];
  Load& load = state.pairs.load[p];
  thread_local PatchTouches found;
  found.count = 0;
  found.gap = far_apart(model, state.bodies, state.pairs.pair[p]);
  if (!(found.gap > 0)) {
    std::array<PatchMark, kMostPatches> marks;
    for (std::size_t k = 0; k < patches.count; ++k) marks[k] = patches.patch[k].mark;
    const std::span<const PatchMark> known(marks.data(), patches.count);
    const FieldPellet of_a = pellet(model, state.bodies, a);
    if (is_container(b))
      touch_patches(of_a, *model.wall_field[b - kSide], travelled, known, near, found);
    else
      touch_patches(of_a, pellet(model, state.bodies, b), travelled, known, near, found);
  }
  if (found.count == 0) {
    if (load.delta > 0) part(load, record);
    patches.count = 0;
    state.pairs.look_at[p] = travelled + std::max(0.0, found.gap);
    return;
  }
  if (!same_patches(found, patches.count)) carry_on(found, patches, record);
  load = Load{};
  load.delta = found.delta;
  record.elastic = 0;
  for (std::size_t k = 0; k < found.count; ++k) {
    const Touch& touch = found.touch[k];
    PatchRecord& patch = patches.patch[k];
    const Vec3 others = load.force;
    patch.stretched = push(model, state.bodies, state.pairs.pair[p], touch, patch.spring, load, record);
    patch.force = load.force - others;
    patch.delta = touch.delta;
    patch.mark = {touch.point, touch.gradient.normalized()};
  }
  if (patches.count > 1) join(patches, model.size, record);
  count_touch(model, state.bodies, state.pairs.pair[p], found.depth, record);
}

}  // namespace packbed::mesh
