#pragma once
// The phases of a step, one file each.
#include <array>
#include <string_view>

#include "dynamics/neighbours.hpp"
#include "lattice/surroundings.hpp"
#include "math/random.hpp"
#include "packers/feed.hpp"
#include "packers/lattice/collisions.hpp"
#include "packers/lattice/model.hpp"

namespace packbed::lattice {

enum Phase : std::size_t { kFeed, kMove, kRest, kPhases };
inline constexpr std::array<std::string_view, kPhases> kPhaseName{"feed", "move", "rest"};

/// Lets pellets in that are due, each at its exact pose; one that would share a cell is put on the nearest
/// free cells, or waits.
void feed(const Model& model, State& state, Feeder& feeder);
/// Offers every pellet its moves of this step.
void move(const Model& model, State& state);
/// Asks every rest_window steps how far the bed has sunk.
void rest(const Model& model, State& state, const Feeder& feeder);

/// What comes of the turns of a slab's pellets.
struct Turns {
  Tally tally;
  std::vector<Push> pushes;  // digicgp: in the order of the turns
};

/// Memory that is kept from one pellet to the next (one a thread).
struct Workspace {
  explicit Workspace(const Model& model) : maker(model.frame.pitch, model.largest) {}
  StampMaker maker;
  Hits hits;
  Collisions collisions;
  Surroundings surroundings;
};

/// The moves of one pellet: without forces, and guided by the cells that it collides with.
void move_digipac(const Model& model, State& state, std::size_t i, Workspace& work, Turns& turns);
void move_digicgp(const Model& model, State& state, std::size_t i, Workspace& work, Turns& turns);

/// digicgp: who may collide with whom in this step.
void find_near(const Model& model, State& state);
/// digicgp: the collisions of a step guide the next one.
void take_guides(State& state, const std::vector<Turns>& turns);

/// A pellet as it would be after a rotation.
struct Turned {
  Quat rotation;
  Vec3 phase;
  Stamp stamp;
};
Quat turn_about(const Vec3& axis, double angle);
/// What the turn makes of the rotation of pellet i.
Quat turned_rotation(const State& state, std::size_t i, const Quat& turn);
/// Pellet i turned about its centre of mass.
Turned turned_by(const Model& model, const State& state, std::size_t i, const Quat& turn, StampMaker& maker);
/// Makes the rotation of a pellet that is off the lattice.
void take(State& state, std::size_t i, Turned&& turned, Tally& tally);
/// Its random numbers of this step.
Random numbers_of(const Model& model, const State& state, std::size_t i);

}  // namespace packbed::lattice
