#pragma once
// What a run tells of itself; io writes it as summary.json, key by key.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace packbed {

struct AuditLine {
  std::string name;  // "pellets", "rest", "overlap", "energy", "wall forces"
  bool passed = false;
  std::string finding;  // one sentence with the number, its limit and its unit
};

/// A bed at rest before the first tap (number 0), or after one.
struct TapRecord {
  std::int32_t number = 0;
  double time_s = 0, packing_density = 0, top_m = 0;  // top: of the highest pellet's centre
};

struct RunRecord {
  std::string method, kernel, bed_hash;
  std::uint64_t seed = 0;
  int threads = 1;
  struct {
    int asked = 0, fed = 0, inside = 0, escaped = 0;
  } pellets;
  bool at_rest = false;
  std::vector<AuditLine> audit;
  struct {
    double wall_s = 0, cpu_s = 0, setup_s = 0, step_s = 0, simulated_s = 0;
    std::int64_t steps = 0;
    std::map<std::string, double> phases_s;
  } time;
  std::int64_t peak_rss_bytes = 0;
  /// Fractions of the pellet's smallest thickness. rest_* measured from geometry after the run, peak by the
  /// solver during it.
  struct {
    double rest_mean = 0, rest_max = 0, peak = 0;
    double share_above_5_percent = 0;  // of contact evaluations during the run
  } overlap;
  /// All in joule. ledger_error is |unaccounted| / input.
  struct {
    double input = 0, kinetic = 0, potential = 0, elastic = 0, damped = 0, rubbed = 0, removed = 0,
           ledger_error = 0;
  } energy;
  struct {
    double base_force_N = 0, side_shear_N = 0, weight_N = 0;
  } wall;
  std::vector<TapRecord> taps;             // of a bed that was shaken
  std::map<std::string, double> counters;  // contacts evaluated, list rebuilds, wake-ups, ...
  std::vector<std::string> notes;          // what happened on the way that a user should know

  bool audit_passed() const {
    for (const AuditLine& line : audit)
      if (!line.passed) return false;
    return true;
  }
};

}  // namespace packbed
