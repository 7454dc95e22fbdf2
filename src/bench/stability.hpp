#pragma once
// Tests of stability that take too long, or ask for too many poses, for every build; each says what it asks
// and what it found. The others are tests (docs/verification.md).
#include <string>
#include <vector>

namespace packbed::bench {

struct Verdict {
  std::string test, asked, found;
  bool passed = false;
};

Verdict top_keeps_turning(long long steps);
Verdict cloud_keeps_momentum(int steps);
/// Random and degenerate poses of pairs, `kernel` "cylinder" or "field".
Verdict forces_stay_finite(const std::string& kernel, int poses);
/// `impacts` elastic ones of a pellet pair: energy kept at 20 and at 40 steps a contact.
Verdict impacts_keep_energy(const std::string& pellet, int impacts);
/// A cylinder that strikes a plane with its rim, sliding, against the exact impact of a rigid body.
Verdict oblique_rim_impact(double degrees, double friction);
/// Two cylinders on a floor and a third in the cleft between them stand when `pellet_friction` is above tan
/// 15 degrees and `floor_friction` above a third of it, and only then.
Verdict pyramid_stands_or_falls(double pellet_friction, double floor_friction);
/// Pellets placed 10 % of their diameter inside one another part gently, or are refused.
Verdict deep_start_is_gentle();
/// Rings that hit each other with their edges at 5 m/s never pass through one another.
Verdict rings_bounce_off(int pairs);
/// A case with one wild setting is refused with words, or its audit fails, or the bed is good.
std::vector<Verdict> wild_settings(const std::string& case_file);

}  // namespace packbed::bench
