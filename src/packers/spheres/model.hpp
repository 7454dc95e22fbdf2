#pragma once
// The sphere packer's two records: Model never changes in a run, State is all that does (and all that a
// checkpoint holds).
//
// Spheres stand in memory in the order of a space-filling curve, in fixed chunks. A chunk computes the pairs
// that its spheres have found; what a pair does to a sphere of another chunk goes into a slot, which that
// chunk adds later. So the order of every sum is that of the lists, whatever the number of threads.
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "bed/scene.hpp"
#include "contact/sphere_pairs.hpp"
#include "dynamics/level_grid.hpp"
#include "packers/rest_watch.hpp"
#include "packers/spheres/solid_wall.hpp"

namespace packbed::spheres {

struct Kind {
  double radius = 0;                 // of scale 1 [m]
  double density = 0;                // [kg/m3]
  double smallest = 1, largest = 1;  // scale of its pellets
};

struct Model {
  std::vector<Kind> kinds;
  Container container;
  std::vector<SphereWall> walls;           // flat and round ones; the first is the floor
  std::shared_ptr<const SolidWall> solid;  // of a container that was not recognised, instead of these
  Vec3 gravity = Vec3::Zero(), up = Vec3::UnitZ();
  SphereLaw pellet_law, wall_law;
  bool turns = false, rolls = false;  // some law has friction, rolling friction
  bool gear = false;                  // integrator: Gear's instead of velocity Verlet
  double step = 0;                    // [s]
  double smallest_stiffness = 0;      // dF/ddelta of two of the smallest spheres in the hardest impact [N/m]
  double skin = 0;                    // of the lists, fraction of the radius
  bool sleeps = false;                // what has settled stands still
  double swing = 0;                   // see swing_of, of the smallest sphere [rad/s]
  std::int64_t watch = 1;             // steps over which it must stay to fall asleep
  Stepping stepping;
  double expected_time = 0;  // of the whole run, for the progress line [s]
};

/// Throws InputError for a scene that cannot be packed as given.
Model make_model(const Scene& scene);

/// How fast a sphere swings on a light contact with its like [rad/s].
double swing_of(const Model& model, double radius, double inverse_mass);

/// One entry a sphere, in memory order.
struct Spheres {
  std::vector<std::uint32_t> id, kind;
  std::vector<double> scale;
  std::vector<Quad> place;     // centre, radius [m]
  std::vector<Quad> velocity;  // [m/s], inverse mass [1/kg] (0: fixed)
  std::vector<Quad> spin;      // [rad/s], inverse moment of inertia [1/(kg m2)]
  std::vector<Quad> force,
      twist;                    // [N], torque over minus the radius [N]; entries beyond the spheres are slots
  std::vector<Quad> listed_at;  // centre at the last search, square of the way that it may go [m], [m2]

  std::size_t size() const { return id.size(); }
};

/// Of Gear's scheme only: scaled derivatives dt^n / n! d^n x / dt^n, one entry a sphere; empty otherwise.
struct Gear {
  std::array<std::vector<Quad>, 4> position;  // n = 2 to 5 [m]
  std::array<std::vector<Quad>, 4> spin;      // n = 1 to 4 [rad/s]
  std::vector<Quad> ahead, spin_ahead;        // predicted velocity [m/s], spin [rad/s]
};

inline constexpr std::size_t kChunk = 512;  // spheres
inline std::size_t chunks_of(std::size_t spheres) {
  return (spheres + kChunk - 1) / kChunk;
}

/// Pairs in the order of the spheres that found them: those of sphere i are numbers first[i] to first[i + 1].
/// A chunk begins with a new block; lanes that are left over at its end are of no use. Late lists are
/// in the order in which pairs were found, without `first`.
struct List {
  std::vector<PairBlock> block;
  std::vector<std::uint32_t> first;
  std::vector<SpringBlock> slip, roll;  // empty without friction, without rolling friction
  std::vector<DashBlock> dash;
  std::uint32_t filled = 0;  // lanes; of a late list those in use

  std::uint32_t a(std::size_t pair) const { return block[pair / kLanes].a[pair % kLanes]; }
  std::uint32_t b(std::size_t pair) const { return block[pair / kLanes].b[pair % kLanes]; }
  std::size_t lanes() const { return kLanes * block.size(); }
  /// The block that the pairs of a chunk's first sphere begin with; of the number of spheres: the end.
  std::size_t block_of(std::size_t sphere) const { return first[sphere] / kLanes; }
  SphereMemory memory_from(std::size_t block_) {
    return {slip.empty() ? nullptr : slip.data() + block_, roll.empty() ? nullptr : roll.data() + block_,
            dash.data() + block_};
  }
};

/// The pairs of a list that each sphere is in: a chain of lanes, numbered from 1, from its last to its first.
struct PairChains {
  std::vector<std::uint32_t> last;                   // of each sphere; 0: none
  std::vector<std::array<std::uint32_t, 2>> before;  // of each lane, for its a and for its b
};

/// What has changed since the last search.
struct Late {
  List pairs, walls;                 // what is in no other list
  std::vector<std::uint32_t> moved;  // the spheres that were listed anew
  std::size_t woken = 0;             // of sleepers
  std::vector<Quad> reach;           // of each sphere at the search: centre [m], radius and margin [m]
  // made when they are needed; in no checkpoint
  std::shared_ptr<const LevelGrid> grid;  // of `reach`
  PairChains chains;                      // of `pairs`
};

/// One entry a sphere, in memory order; beyond `anchor` of use to sleepers only.
struct Sleepers {
  static constexpr std::uint8_t kAwake = 0, kInland = 1, kShore = 2, kWaking = 3;
  std::vector<std::uint8_t> is;       // kInland: none of its pairs is listed; kShore: some are
  std::vector<std::uint8_t> watch;    // binary logarithm of its watch over that of the smallest
  std::vector<std::uint8_t> watched;  // since the last watch began
  std::vector<Quad> anchor;           // centre when that began [m]
  std::vector<Quad> held, change;     // force of the listed pairs that it is balanced with, change since [N]
  std::vector<std::uint8_t> other_pairs;  // others are listed than `held` is of
  std::vector<Quad> shift, rate;          // of its shadow [m], [m/s]; w: see swing_of [rad/s]
  std::size_t count = 0, since_search = 0;
  double sleeps = 0, wakes = 0, removed = 0;  // removed: energy [J]

  /// Calls visit with each of the vectors of z, which may be const.
  template <class Self, class Visit>
  static void each_of(Self& z, const Visit& visit) {
    visit(z.is), visit(z.watch), visit(z.watched), visit(z.anchor), visit(z.held), visit(z.change);
    visit(z.other_pairs), visit(z.shift), visit(z.rate);
  }
};

struct State {
  double time = 0;  // simulated [s]
  std::int64_t steps = 0;
  Spheres spheres;
  Gear gear;
  // Pairs of two spheres that touched at the last search, and that did not: blocks of these are looked at and
  // seldom more. Pairs of a sphere and a wall of the model's list.
  List pairs, near, walls;
  List still, still_walls;  // of sleepers with sleepers and walls; outside the loops
  Late late;
  Sleepers sleepers;
  // slots, entries of force and twist beyond the spheres: those of sphere i are slot[slot_first[i]] and on
  std::vector<std::uint32_t> slot, slot_first;
  std::vector<std::uint32_t> first_slot;  // of each chunk, which alone writes them
  std::vector<SphereTally> tally;         // one a chunk and one of the late pairs, since the last search
  std::uint8_t kick_due = 0;              // the second half of the last step's
  std::uint8_t search_due = 1;            // of all spheres
  std::vector<std::uint8_t> strayed;      // of each chunk: one of its spheres has left its margin
  std::int64_t searches = 0, relisted = 0;
  double flight_steps = 60;  // so many steps may a sphere that touches nothing go before it is listed anew
  RestWatch rest;            // by pellet id
  std::uint8_t waited = 0;
  std::int64_t snapshots = 0;
  double wall_s = 0, cpu_s = 0;  // spent before the last checkpoint
  struct {
    double input = 0, damped = 0, rubbed = 0;  // [J]
    double peak = 0, touches = 0, deep = 0;
    double listed = 0;  // pairs walked over, added up over all steps
  } ledger;
};

}  // namespace packbed::spheres
