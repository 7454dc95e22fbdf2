// Phase touch of digidem: deepest overlap, direction and point from the shared cells, then spring and dashpot
// along the normal and across it, as in the paper's equation, with Coulomb's limit.
#include <algorithm>
#include <cmath>

#include "math/threads.hpp"
#include "packers/lattice/dem.hpp"

namespace packbed::lattice {
namespace {

/// Cells that two bodies slide, part or roll while what a new count has changed comes in by all but a third.
/// It must not come in by itself, with time: that pushes resting bodies apart again and again, and no bed of
/// thin walls cools. Nor over two cells of way: what is then pushed out of its neighbour is pushed the harder
/// for it.
constexpr double kFade = 8;

/// Where the normal on a is looked for before cells tell: from b's centre, or from the wall.
Vec3 first_guess(const DemState& state, const Touch& t) {
  const Vec3& x = state.bodies.position[t.a];
  if (t.b == kFloor) return Vec3::UnitZ();
  const Vec3 way = t.b == kSide ? Vec3(-x.x(), -x.y(), 0) : Vec3(x - state.bodies.position[t.b]);
  return way.norm() > 0 ? Vec3(way.normalized()) : Vec3::UnitZ();
}

void look_at(const DemState& state, Touch& t, const SharedCells& cells) {
  t.meets = cells.count > 0;
  if (t.meets) t.patch = patch_of(cells, first_guess(state, t));
}

/// Counts the shared cells when a stamp has changed; true then.
bool count_cells(const DemModel& model, const DemState& state, Touch& t) {
  const std::uint32_t version_b = is_wall(t.b) ? 1 : state.version[t.b];
  if (t.seen_a == state.version[t.a] && t.seen_b == version_b) return false;
  t.seen_a = state.version[t.a];
  t.seen_b = version_b;
  const Vec3 guess = t.normal.squaredNorm() > 0 ? t.normal : first_guess(state, t);
  constexpr double kShare = 0.38;  // of the normal: a lead along the nearest of the 26 neighbours
  Cell at = state.cell[t.a];
  for (std::size_t d = 0; d < 3; ++d) {
    const double n = guess[static_cast<int>(d)];
    t.lead[d] = std::abs(n) < kShare ? 0 : n > 0 ? -1 : 1;
    at[d] += t.lead[d];
  }
  const Stamp& a = state.stamp[t.a];
  if (!is_wall(t.b)) {
    const Cell& b = state.cell[t.b];
    look_at(state, t, shared_cells(a, state.stamp[t.b], {b[0] - at[0], b[1] - at[1], b[2] - at[2]}));
    return true;
  }
  // the tube's floor and its side are two touches; a mesh container is one
  const bool tube = model.base.scene->container.kind == ContainerKind::tube;
  const int high = t.b == kFloor ? 0 : model.base.frame.size[2], low = t.b == kSide && tube ? 0 : -2;
  look_at(state, t, shared_cells(a, state.walls, at, low, high));
  return true;
}

/// Way of body i's material at `arm` from its centre since its stamp was made and laid [m].
Vec3 way_since(const DemState& state, std::size_t i, const Vec3& arm) {
  return state.offset[i] + state.turn[i].cross(arm);
}

/// Where a touch acts.
struct Place {
  Vec3 arm_a, arm_b;  // of the point from the centres [m]
  double area = 0;    // [m2]
};

struct Moving {
  Vec3 velocity, spin;  // of a against b at the point
  double mass = 0;      // effective [kg]
};

Moving relative(const DemState& state, const Touch& t, const Place& place) {
  const Bodies& b = state.bodies;
  Moving m{b.velocity[t.a] + b.spin[t.a].cross(place.arm_a), b.spin[t.a], 0};
  double inverse = b.inverse_mass[t.a];
  if (!is_wall(t.b)) {
    m.velocity -= b.velocity[t.b] + b.spin[t.b].cross(place.arm_b);
    m.spin -= b.spin[t.b];
    inverse += b.inverse_mass[t.b];
  }
  m.mass = 1 / inverse;
  return m;
}

/// What the cells tell: the point of the touch [m], and the depth there now [m], negative when apart.
struct Told {
  Vec3 point;
  double depth = 0;
};

Told told_by_cells(const DemModel& model, const DemState& state, const Touch& t) {
  const double pitch = model.base.frame.pitch;
  const Cell& c = state.cell[t.a];
  const Vec3 lead(t.lead[0], t.lead[1], t.lead[2]);
  Told told;
  told.point =
      model.base.frame.centre(c[0], c[1], c[2]) + pitch * (t.patch.point + 0.5 * lead) + state.offset[t.a];
  const std::vector<Vec3>& x = state.bodies.position;
  Vec3 way = way_since(state, t.a, told.point - x[t.a]);
  if (!is_wall(t.b)) way -= way_since(state, t.b, told.point - x[t.b]);
  told.depth = pitch * (t.patch.depth + lead.dot(t.patch.normal)) - way.dot(t.patch.normal);
  return told;
}

/// Depth, normal and point, and how the bodies move there; false when apart.
bool find_place(const DemModel& model, const DemState& state, bool counted, Touch& t, Place& place,
                Moving& moving) {
  t.depth = 0;
  if (!t.meets) {
    t.known = 0;
    return false;
  }
  const double pitch = model.base.frame.pitch;
  const Told told = told_by_cells(model, state, t);
  if (!t.known) {
    t.normal = t.patch.normal;
    t.aside.setZero();
    t.bias = std::min(0.0, told.depth) - told.depth;
  } else if (counted) {  // as it was before
    t.aside = t.point - told.point;
    t.bias = t.last - told.depth;
  }
  t.point = told.point + t.aside;
  place.arm_a = t.point - state.bodies.position[t.a];
  if (!is_wall(t.b)) place.arm_b = t.point - state.bodies.position[t.b];
  place.area = std::max(t.patch.area, 1.0) * pitch * pitch;
  t.last = told.depth + t.bias;
  t.depth = std::max(0.0, t.last);
  t.known = 1;

  moving = relative(state, t, place);
  const double passed =
      model.step * (moving.velocity.norm() + moving.spin.norm() * state.bodies.bounding_radius[t.a]);
  const double share = std::min(1.0, passed / (kFade * pitch));
  const Vec3 normal = t.normal + share * (t.patch.normal - t.normal);
  t.normal = normal.norm() > 0 ? Vec3(normal.normalized()) : t.patch.normal;
  t.aside -= share * t.aside;
  t.bias -= share * std::clamp(t.bias, -pitch, pitch);
  return t.depth > 0;
}

/// Force and couple on a. The spring and the dashpot are spread over the patch, which resists rocking as it
/// does sinking: radius of gyration squared of a disc, area / (4 pi).
void push(const DemState& state, const DemLaw& law, double step, const Place& place, const Moving& m,
          Touch& t) {
  const double damping = 2 * law.damping_ratio * std::sqrt(law.stiffness * m.mass);
  const double along = m.velocity.dot(t.normal);
  const double normal = std::max(0.0, law.stiffness * t.depth - damping * along);
  const Vec3 sliding = m.velocity - along * t.normal;
  constexpr double kShear = 2.0 / 7;  // tangential over normal stiffness
  const double shear = kShear * law.stiffness, shear_damping = std::sqrt(kShear) * damping;
  t.spring -= t.normal * t.normal.dot(t.spring);
  t.spring += step * sliding;
  Vec3 rub = -shear * t.spring - shear_damping * sliding;
  const double limit = law.friction * normal, size = rub.norm();
  if (size > limit) {
    rub *= size > 0 ? limit / size : 0;
    t.spring = shear > 0 ? Vec3(-rub / shear) : Vec3::Zero();
  }
  t.force = normal * t.normal + rub;
  const double gyration = place.area / (4 * kPi);
  Vec3 tilt = state.turn[t.a];
  if (!is_wall(t.b)) tilt -= state.turn[t.b];
  tilt -= tilt.dot(t.normal) * t.normal;
  t.couple = -gyration * (law.stiffness * tilt + damping * m.spin);
  // a touch that does not pull cannot hold a couple larger than its force at the patch's rim
  const double most = normal * std::sqrt(place.area / kPi), couple = t.couple.norm();
  if (couple > most) t.couple *= most / couple;
}

}  // namespace

void dem_touch(const DemModel& model, DemState& state) {
  find_active(state);
  parallel_for(state.active.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Touch& t = state.touches[state.active[k]];
      const bool counted = count_cells(model, state, t);
      if (!t.meets && !t.known && !(t.depth > 0)) continue;
      t.force = t.couple = Vec3::Zero();
      Place place;
      Moving moving;
      if (find_place(model, state, counted, t, place, moving))
        push(state, is_wall(t.b) ? model.wall : model.pellet, model.step, place, moving, t);
    }
  });
  Bodies& b = state.bodies;
  b.force = state.resting_force;
  b.torque = state.resting_torque;
  for (const std::uint32_t k : state.active) {  // in the order of the list
    const Touch& t = state.touches[k];
    if (!(t.depth > 0)) continue;
    state.peak = std::max(state.peak, t.depth);
    add_forces(t, b.position, b.force, b.torque);
  }
}

}  // namespace packbed::lattice
