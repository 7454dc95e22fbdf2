#pragma once
// What benches leave behind: a CSV and pictures each, and one page that shows all of them.
#include <string>
#include <vector>

#include "bench/bench.hpp"

namespace packbed::bench {

struct Finished {
  const Bench* bench = nullptr;
  Outcome outcome;
  double cpu_s = 0;
};

/// The machine's own name of its processor.
std::string processor_name();
/// NAME.csv and its pictures; throws SystemError.
void write_outcome(const std::string& folder, const Finished& finished, const Options& options);
/// bench.html, self-contained.
void write_page(const std::string& folder, const std::vector<Finished>& all, const Options& options);

}  // namespace packbed::bench
