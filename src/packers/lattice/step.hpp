#pragma once
// The phases of a step, one file each.
#include <array>
#include <functional>
#include <string_view>

#include "dynamics/neighbours.hpp"
#include "math/random.hpp"
#include "packers/feed.hpp"
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

/// The moves of one pellet: without forces, and guided by the cells that it collides with.
void move_digipac(const Model& model, State& state, std::size_t i, StampMaker& maker, Turns& turns);
void move_digicgp(const Model& model, State& state, std::size_t i, StampMaker& maker, Turns& turns);

/// digicgp: who may collide with whom in this step.
void find_near(const Model& model, State& state);
/// digicgp: the collisions of a step guide the next one.
void take_guides(State& state, const std::vector<Turns>& turns);

/// Moves a pellet by one cell unless it would share a cell then.
bool try_move(State& state, std::size_t i, int axis, int sign, Tally& tally);
/// Rotates a pellet about an axis through its centre of mass unless it would share a cell then; `blocked`,
/// when given, sees what did not fit while the pellet itself is off the lattice.
bool try_rotation(const Model& model, State& state, std::size_t i, const Vec3& axis, double angle,
                  StampMaker& maker, Tally& tally,
                  const std::function<void(const Stamp& tried, const Vec3& phase)>& blocked = {});
/// Its random numbers of this step.
Random numbers_of(const Model& model, const State& state, std::size_t i);

}  // namespace packbed::lattice
