#pragma once
// The mesh packer's two records: Model never changes in a run, State is all that does (and all that a
// checkpoint holds).
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bed/scene.hpp"
#include "contact/cylinder.hpp"
#include "contact/field.hpp"
#include "contact/law.hpp"
#include "contact/patches.hpp"
#include "dynamics/bodies.hpp"
#include "dynamics/doze.hpp"
#include "dynamics/neighbours.hpp"
#include "packers/rest_watch.hpp"
#include "packers/shaking.hpp"

namespace packbed::mesh {

enum class Kernel : std::uint8_t { sphere, cylinder, field };

/// A pellet kind with its numbers found, at scale 1.
struct Kind {
  ShapePtr shape;
  Kernel kernel = Kernel::cylinder;
  double mass = 0;                            // [kg]
  Vec3 inertia = Vec3::Zero();                // principal moments [kg m2]
  double bounding_radius = 0, thickness = 0;  // [m]
  double radius = 0;                          // of the sphere of equal volume [m]
  double smallest = 1, largest = 1;           // scale of its pellets
  std::shared_ptr<const FieldBody> field;     // made only for Kernel::field
};

/// Fraction of a wall's thickness. Nearer to its middle a depth no longer tells from which side it counts,
/// and bodies may pass through each other: a run in which something is so deep in a wall ends there and
/// fails.
inline constexpr double kPierced = 0.3;
/// Fraction of the thinnest wall that a body may go in one step: what goes farther might never be seen
/// inside.
inline constexpr double kMostStride = 0.1;

struct Model {
  std::vector<Kind> kinds;
  Container container;
  // sides of a box, floor, wall and solid, in the order of their numbers below; made only for Kernel::field
  std::array<std::shared_ptr<const FieldWall>, 7> wall_field;
  Vec3 gravity = Vec3::Zero(), up = Vec3::UnitZ();
  LawNumbers pellet_law, wall_law;
  double step = 0;  // [s]
  double skin = 0;  // [m]
  double size = 0;  // of the smallest pellet, the yardstick of rest and sleep [m]
  Stepping stepping;
  double thinnest_wall = 0;  // of kinds that are not convex, which something may be pressed through [m]
  Shaking shaking;
  bool may_fly = false;      // fed bodies may leap: there is gravity and nothing stands above the bed
  double expected_time = 0;  // of the whole run, for the progress line [s]
};

/// Whether its pairs are looked at by the field kernel; then all are.
inline bool uses_fields(const Model& model) {
  return model.kinds.front().kernel == Kernel::field;
}
/// Throws InputError for a scene that cannot be packed as given.
Model make_model(const Scene& scene);
/// "sphere", "cylinder", "field", or several with "+".
std::string kernel_name(const Model& model);

// Partners that stand for the container in a pair, after all bodies in sorted order.
inline constexpr std::uint32_t kSide = 0xfffffff9;  // of a box: this and the three after it
inline constexpr std::uint32_t kFloor = 0xfffffffd, kWall = 0xfffffffe, kSolid = 0xffffffff;
inline bool is_side(std::uint32_t b) {
  return b >= kSide && b < kFloor;
}
inline bool is_container(std::uint32_t b) {
  return b >= kSide;
}

/// What a pair does to its bodies now: all that summing up needs, by itself for the sake of the cache.
struct Load {
  double delta = 0;                                       // solver's overlap [m]; 0: apart
  Vec3 force = Vec3::Zero();                              // on a [N]
  Vec3 torque_a = Vec3::Zero(), torque_b = Vec3::Zero();  // [N m]
};

/// What else a pair remembers between steps.
struct PairRecord {
  Spring spring;
  Vec3 point = Vec3::Zero();      // [m]
  double elastic = 0;             // stored now [J]
  double damped = 0, rubbed = 0;  // lost since the last search [J]
  double held = 0;                // size of the force when one of the two fell asleep [N]
  double peak = 0;                // greatest depth since the last search, fraction of the thickness
  // touching steps since the last search, and those deeper than 5 % of the thickness
  std::uint32_t touches = 0, deep_touches = 0;
};

/// A patch of a pair of the field kernel, between steps.
struct PatchRecord {
  PatchMark mark;
  Spring spring;
  Vec3 force = Vec3::Zero();  // on a [N]
  double delta = 0;           // [m]
  double stretched = 0;       // energy in the springs of friction [J]
};
struct PatchRecords {
  std::array<PatchRecord, kMostPatches> patch;
  std::size_t count = 0;
};

struct Pairs {
  std::vector<BodyPair> pair;   // ascending
  std::vector<double> look_at;  // no touch before the travel of both bodies adds up to this [m]
  std::vector<Load> load;
  std::vector<PairRecord> record;
  // of the kernels of spheres and cylinders: what is known of a pair stays where it is while the list changes
  std::vector<std::uint32_t> slot;  // of a pair, in `features`
  std::vector<RodFeatures> features;
  std::vector<std::uint32_t> vacant;  // slots
  // of the field kernel, else empty
  std::vector<PatchRecords> patches;
  std::vector<NearPoints> near;       // not in checkpoints: they change no result
  std::vector<std::uint32_t> active;  // those with a body that moves
  // bodies to pairs: entries 2 * pair + side of body i stand at first[i] .. first[i + 1]
  std::vector<std::uint32_t> first, entry;
  std::vector<std::uint32_t> shore;  // sleepers beside something that moves, ascending
  std::uint8_t shore_stale = 1;
};

/// Totals since the start, each added in fixed order.
struct Ledger {
  double input = 0, damped = 0, rubbed = 0, removed = 0;  // [J]
  double peak = 0;                                        // greatest depth, fraction of the thickness
  double touches = 0, deep_touches = 0;                   // see PairRecord
  double searches = 0, wakes = 0, sleeps = 0;
  double stride = 0;             // farthest way of a body in one step, fraction of the thinnest wall
  double awake = 0, active = 0;  // bodies stepped and pairs walked over, added up over all steps
};

struct State {
  double time = 0;  // simulated [s]
  std::int64_t steps = 0;
  Bodies bodies;
  std::vector<double> flight_end;   // of airborne bodies: when they may meet others in flight or the wall [s]
  std::vector<double> flight_from;  // of airborne bodies: time at which their arrays stand [s]
  std::vector<Vec3> listed_at;      // position at the last search [m]
  std::vector<double> margin;       // way that each body may go before the next search [m]
  std::vector<Doze> doze;
  Pairs pairs;
  std::vector<std::uint32_t> awake;  // ascending
  double next_landing = 0;           // [s]
  std::uint8_t search_due = 1;
  RestWatch rest;
  ShakeState shake;
  std::uint8_t waited = 0;       // feeding has had to wait for room
  std::int64_t snapshots = 0;    // taken so far
  double wall_s = 0, cpu_s = 0;  // spent before the last checkpoint
  Ledger ledger;
};

/// Something has been pressed so far into a wall, or goes so fast, that the run cannot go on.
inline bool pierced(const Model& model, const State& state) {
  return model.thinnest_wall > 0 && (state.ledger.peak > kPierced || state.ledger.stride > kMostStride);
}

}  // namespace packbed::mesh
