#pragma once
// One step of the sphere packer and its phases. The timers in the summary carry the names of these functions.
#include <array>
#include <string_view>

#include "packers/feed.hpp"
#include "packers/spheres/model.hpp"

namespace packbed::spheres {

enum Phase : std::size_t { kFeed, kFindPairs, kKickDrift, kTouch, kFinishKick, kSleep, kRest, kPhases };
inline constexpr std::array<std::string_view, kPhases> kPhaseName = {
    "feed", "find_pairs", "kick_drift", "touch", "finish_kick", "sleep", "rest"};
using PhaseTimes = std::array<double, kPhases>;  // wall-clock [s]

/// Velocity Verlet, or Gear's scheme, with contacts; everything else only when it is due.
void step(const Model& model, State& state, Feeder& feeder, PhaseTimes& times);

// The phases, in order. Each returns at once when it has nothing to do.
void feed(const Model& model, State& state, Feeder& feeder);
void find_pairs(const Model& model, State& state);
void kick_drift(const Model& model, State& state);
void touch(const Model& model, State& state);
/// The second half of the step of velocities and spins, which kick_drift else does with the first half of the
/// next: for who wants to see velocities or whole forces.
void finish_kick(const Model& model, State& state);
// In place of the two, with Gear's scheme.
void predict(const Model& model, State& state);
void correct(const Model& model, State& state);
void sleep(const Model& model, State& state);
void rest(const Model& model, State& state, const Feeder& feeder);

/// Gives spheres that have entered since the last call their higher derivatives: none but gravity.
void begin_gear(const Model& model, State& state);
/// Adds what the chunks have counted since the last search to the ledger, in order.
void settle_accounts(State& state);
SphereView view_of(Spheres& spheres);
/// The blocks of a list of walls from number `from` up to `to`; see SphereWork for the rest.
void touch_container_walls(const Model& model, Spheres& spheres, List& list, double step, std::size_t from,
                           std::size_t to, SphereTally& tally, SphereContact* contacts = nullptr);
/// Walls beside the spheres of these blocks as touch_given_walls wants them, of a mesh container.
std::vector<Quad> sides_of(const Model& model, const Spheres& spheres, const List& list, std::size_t from,
                           std::size_t to);

}  // namespace packbed::spheres
