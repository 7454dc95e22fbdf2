#pragma once
// The progress line: one line that renews itself on a terminal, a plain line now and then in a pipe.
#include "packers/packer.hpp"

namespace packbed::cli {

class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  void show(const Progress& progress);
  void end();  ///< leaves the terminal on a fresh line

 private:
  bool quiet_, terminal_, shown_ = false;
  double start_, last_plain_ = 0, first_fraction_ = -1;
};

}  // namespace packbed::cli
