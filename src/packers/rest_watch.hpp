#pragma once
// Is a bed at rest? Three questions, asked together over one window: how fast, how far from balance, how far
// drifted.
#include <cstdint>
#include <vector>

#include "bed/scene.hpp"

namespace packbed {

struct RestWatch {
  double since = 0;          // the present window [s]
  std::vector<Vec3> anchor;  // positions when it began, one a pellet [m]
  std::uint8_t at_rest = 0;
  double speed = 0, force = 0, drift = 0;  // found at its end: [m/s], fraction of the weight, of the size
  std::int32_t rollers = 0;                // pellets that drifted by more than the limit
  std::uint8_t last_watch = 0;             // windows since all were woken, to see whether it stays at rest
};

/// Names every member once, for checkpoints.
template <class Archive, class Rest>
void visit_rest(Archive& io, Rest& r) {
  io(r.since), io(r.anchor), io(r.at_rest), io(r.speed), io(r.force), io(r.drift), io(r.rollers),
      io(r.last_watch);
}

/// The questions at the end of a window.
class RestLook {
 public:
  explicit RestLook(RestWatch& watch) : watch_(watch) {}

  /// Pellet `i`, which can move: twice its kinetic energy over its mass [m2/s2], its unbalanced force over
  /// its weight, its position, and the size that its drift is measured by [m].
  void add(std::size_t i, double speed2, double unbalanced, const Vec3& position, double size);
  /// `flying`: some pellet is in free flight.
  void finish(const Stepping& limits, double time, bool flying);

 private:
  RestWatch& watch_;
  struct Pellet {
    double drift, speed2, unbalanced;
  };
  std::vector<Pellet> pellets_;
};

/// Rest found with sleepers is not yet rest: true when all have to wake now, and the same questions will be
/// asked over the next windows. If one pellet rolls on through all of them, the others may sleep again.
bool ask_once_more(RestWatch& watch);

}  // namespace packbed
