#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace packbed::cli {
namespace {

constexpr double kPlainSeconds = 10;  // between two lines in a pipe

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// `gained`: the fraction that `elapsed` seconds have brought.
std::string time_left(double elapsed, double gained, double fraction) {
  if (fraction >= 1) return ", waiting for rest";
  if (gained < 0.005 || elapsed < 1) return "";
  const long left = std::lround(elapsed * (1 - fraction) / gained);
  if (left >= 3600) return fmt::format(", {} h {:02d} min left", left / 3600, left / 60 % 60);
  return left >= 60 ? fmt::format(", {} min {:02d} s left", left / 60, left % 60)
                    : fmt::format(", {} s left", left);
}

}  // namespace

ProgressLine::ProgressLine(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), start_(now()) {}

void ProgressLine::show(const Progress& p) {
  if (quiet_) return;
  const double elapsed = now() - start_;
  if (first_fraction_ < 0) first_fraction_ = p.fraction;  // of a run that is resumed, more than 0
  if (!terminal_ && elapsed - last_plain_ < kPlainSeconds) return;
  last_plain_ = elapsed;
  const std::string line =
      fmt::format("{:3.0f} %  {}  {} of {} pellets, {:.3f} s simulated{}", 100 * p.fraction, p.phase, p.fed,
                  p.asked, p.simulated_s, time_left(elapsed, p.fraction - first_fraction_, p.fraction));
  std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", line.c_str());
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::end() {
  if (shown_ && terminal_) std::fprintf(stderr, "\r\033[K");
  shown_ = false;
}

}  // namespace packbed::cli
