#pragma once
// What a run has used so far.
#include <cstdint>

namespace packbed {

double wall_seconds();          ///< since some fixed instant [s]
double cpu_seconds();           ///< processor time of all threads of this process [s]
std::int64_t peak_rss_bytes();  ///< largest resident memory of this process

}  // namespace packbed
