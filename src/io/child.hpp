#pragma once
// A program run under a deadline, its standard output collected. For libraries that crash, hang or swell on
// bad input: what happens to the child cannot happen to us.
#include <cstddef>
#include <string>
#include <vector>

namespace packbed {

struct ChildResult {
  std::vector<std::byte> output;  // of its standard output
  int exit_code = -1;             // when it ended by itself
  int signal = 0;                 // that ended it; 0: none
  bool timed_out = false;         // we ended it
  bool too_much = false;          // it wrote more than it may; we ended it
};

/// Runs argv[0] with the arguments argv[1...], nothing to read, no error output. Returns when it has ended or
/// after `seconds`, when it is killed. Safe with threads. SystemError when it cannot be started.
ChildResult run_child(const std::vector<std::string>& argv, double seconds, std::size_t largest_output);

/// "SIGSEGV (a crash)" and the like.
std::string signal_name(int signal);

}  // namespace packbed
