#pragma once
// Shaking of a bed that has come to rest: taps, as the CT paper simulates them (the bed gets an upward
// velocity, enough to lift it, and settles again), or a vertical vibration of the container. One schedule for
// all packers whose bodies have velocities; each applies what it says. Rest is asked for as ever between.
#include <optional>
#include <span>

#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"
#include "bed/scene.hpp"

namespace packbed {

struct ShakeState {
  std::int32_t taps = 0;     // given so far
  double vibrates_from = 0;  // [s]
  double vibrates_to = 0;    // [s]; equal: not yet
  std::vector<TapRecord> found;
};

/// Names every member once, for checkpoints.
template <class Archive, class Shake>
void visit_shake(Archive& io, Shake& s) {
  io(s.taps), io(s.vibrates_from), io(s.vibrates_to), io(s.found);
}

/// To be asked when the bed is at rest. Notes its density; returns what is now to be added to the velocity of
/// every pellet (nothing but zero when a vibration begins), or none when there is no more to do.
std::optional<Vec3> next_shake(const Scene& scene, ShakeState& state, double time,
                               const std::vector<Pellet>& pellets);

/// Whether the container vibrates: the bed is not at rest then, whatever it looks like.
inline bool vibrates(const ShakeState& state, double time) {
  return time < state.vibrates_to;
}
/// Acceleration that bodies feel in the frame of the vibrating container, beside gravity [m/s2].
Vec3 shaking_acceleration(const Shaking& shaking, const Vec3& up, const ShakeState& state, double time);

}  // namespace packbed
