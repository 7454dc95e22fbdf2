#pragma once
// digidem: pellets of cells with inertia. Forces come from counting the cells that two pellets share.
//
//   #####            shared cells O: their number over the size of the vector area of the faces that bound
//   them
//   ##OOO***         is the mean depth; the vector area gives the direction, the mean of the cells the point
//     *****          (the faces of a in b, less the faces of b in a, half of it)
//
// Cells are drawn anew only when a pellet has turned by half a cell at its rim, and laid at whole cells;
// between, the depth follows the bodies' own motion at the contact to first order, so that forces do not
// jump.
#include <vector>

#include "dynamics/bodies.hpp"
#include "dynamics/doze.hpp"
#include "dynamics/neighbours.hpp"
#include "lattice/shared_cells.hpp"
#include "packers/feed.hpp"
#include "packers/lattice/model.hpp"
#include "packers/rest_watch.hpp"
#include "packers/shaking.hpp"

namespace packbed::lattice {

struct DemLaw {
  double stiffness = 0, damping_ratio = 0, friction = 0;  // [N/m], of critical, [-]
};

struct DemModel {
  Model base;
  DemLaw pellet, wall;
  std::vector<double> mass;  // of one pellet of each kind at scale 1 [kg]
  double step = 0;           // [s]
  double skin = 0;           // of the neighbour list [m]
  std::int64_t watch = 1;    // steps over which a pellet must stay to fall asleep
  double expected_time = 0;  // of the whole run, for the progress line [s]
  Vec3 gravity = Vec3::Zero();
};

inline constexpr std::uint32_t kFloor = 0xfffffffe, kSide = 0xffffffff;  // stand for b in a touch

inline bool is_wall(std::uint32_t b) {
  return b >= kFloor;
}

/// Two pellets, or a pellet and the container, that may touch. The spring lives as long as the pair is
/// listed.
struct Touch {
  std::uint32_t a = 0, b = 0;
  std::uint32_t seen_a = 0, seen_b = 0;  // versions of the stamps that were counted; 0: none
  std::uint32_t meets = 0;               // they share cells
  std::uint32_t known = 0;               // there is a depth of the last step
  double depth = 0;                      // [m]; <= 0: apart
  // what the shared cells tell, with a moved towards b by `lead` cells, so that a touch is seen before it
  // begins; counted anew when either stamp has changed
  Patch patch;
  Cell lead{0, 0, 0};
  // added to the depth and the point that the cells tell, so that they do not jump when these are counted
  // anew; both fade as the bodies move, and the normal follows likewise
  double bias = 0;             // [m]
  Vec3 aside = Vec3::Zero();   // [m]
  double last = 0;             // depth of the last step, negative when apart [m]
  Vec3 spring = Vec3::Zero();  // tangential [m]
  Vec3 normal = Vec3::Zero();  // on a, of the last touch; zero: none yet
  Vec3 force = Vec3::Zero();   // on a [N]
  Vec3 couple = Vec3::Zero();  // on a, beside the force at the point [N m]
  Vec3 point = Vec3::Zero();   // world [m]
  double held = 0;             // size of the force when one of the two fell asleep [N]
};

struct DemState {
  explicit DemState(const DemModel& model) : walls(model.base.frame, model.base.space, model.base.rim) {}

  Occupancy walls;  // pellets are never written into it
  Bodies bodies;
  std::vector<Quat> drawn;   // rotation that the stamp was made at
  std::vector<Cell> cell;    // that the stamp is laid at
  std::vector<Vec3> offset;  // of the centre of mass from the stamp's own [m], written by drift
  std::vector<Vec3> turn;    // rotation since the stamp was made, as a vector [rad], written by drift
  std::vector<Stamp> stamp;
  std::vector<Vec3> phase;             // of the stamp [cells]
  std::vector<std::uint32_t> version;  // of the stamp and its cell, from 1
  std::vector<Touch> touches;
  std::vector<Doze> doze;
  // made anew when the list of touches or who is awake has changed: touches of something that moves, pellets
  // that are awake, sleepers that have such a touch; what touches between sleepers do to each pellet
  std::vector<std::uint32_t> active, awake, shore;
  std::vector<Vec3> resting_force, resting_torque;
  std::uint8_t stale = 1;
  std::vector<Vec3> listed_at;  // position at the last search [m]
  std::uint8_t search_due = 1, waited = 0;
  double time = 0;
  std::int64_t steps = 0, snapshots = 0, searches = 0, sleeps = 0, wakes = 0;
  RestWatch rest;  // last_watch: the bed seems to be at rest, all are awake and watched once more
  ShakeState shake;
  double peak = 0;  // deepest touch of the run [m]
  double wall_s = 0, cpu_s = 0;

  std::size_t size() const { return bodies.size(); }
};

DemModel make_dem_model(const Scene& scene);

void dem_feed(const DemModel& model, DemState& state, Feeder& feeder);
void dem_find_pairs(const DemModel& model, DemState& state);
void dem_touch(const DemModel& model, DemState& state);
/// Lets settled pellets fall asleep, and wakes those that something would move (dynamics/doze.hpp).
void dem_sleep(const DemModel& model, DemState& state);
void dem_move(const DemModel& model, DemState& state);
void dem_rest(const DemModel& model, DemState& state, const Feeder& feeder);
void dem_shake(const DemModel& model, DemState& state);

/// Adds what a touch does to both.
void add_forces(const Touch& touch, const std::vector<Vec3>& position, std::vector<Vec3>& force,
                std::vector<Vec3>& torque);
void wake_all(DemState& state);
/// Sorts out who is awake, when that has changed.
void find_active(DemState& state);

/// Makes the stamp of pellet i at its present rotation and cell.
void redraw(const DemModel& model, DemState& state, std::size_t i, StampMaker& maker);
/// Lays the stamp at the cell nearest to where the pellet is.
void relay(const DemModel& model, DemState& state, std::size_t i);
std::vector<Pellet> pellets_of(const DemState& state);
double kinetic_speed(const DemState& state);  ///< root mean square of the pellets' speeds [m/s]

}  // namespace packbed::lattice
