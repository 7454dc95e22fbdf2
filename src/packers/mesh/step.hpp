#pragma once
// One step of the mesh packer and its phases. The timers in the summary carry the names of these functions.
#include <array>
#include <string_view>

#include "packers/feed.hpp"
#include "packers/mesh/model.hpp"

namespace packbed::mesh {

enum Phase { kFeed, kFindPairs, kKickDrift, kTouch, kGatherKick, kSleep, kRest, kPhases };
inline constexpr std::array<std::string_view, kPhases> kPhaseName = {
    "feed", "find_pairs", "kick_drift", "touch", "gather_kick", "sleep", "rest"};
using PhaseTimes = std::array<double, kPhases>;  // wall-clock [s]

/// Before the first step: pellets that were placed may overlap already. Their forces count in the first half
/// step, and what their contacts hold is energy put in.
void begin(const Model& model, State& state, Feeder& feeder);
/// Velocity Verlet with contacts; everything else only when it is due.
void step(const Model& model, State& state, Feeder& feeder, PhaseTimes& times);

// The phases, in order. Each returns at once when it has nothing to do.
void feed(const Model& model, State& state, Feeder& feeder);
void find_pairs(const Model& model, State& state);
void kick_drift(const Model& model, State& state);
void touch(const Model& model, State& state);
void gather_kick(const Model& model, State& state);
void sleep(const Model& model, State& state);
void rest(const Model& model, State& state, const Feeder& feeder);

/// Gives a bed at rest what the scene's shaking says next; false when there is no more.
bool shake(const Scene& scene, State& state);

/// Ends all sleep.
void wake_all(State& state);
/// Brings airborne bodies to the present time.
void catch_up(const Model& model, State& state);
/// Adds what the pairs have lost since the last search to the ledger, in pair order.
void settle_accounts(State& state);
/// Force and torque on body i from the pairs as they stand, without gravity.
void gather(const State& state, std::size_t i, Vec3& force, Vec3& torque);

}  // namespace packbed::mesh
