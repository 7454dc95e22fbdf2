// A child may end in any way; the parent only hears of it.
#include "io/child.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

#include "math/error.hpp"

namespace packbed {
namespace {

ChildResult shell(const std::string& script, double seconds = 10, std::size_t most = 1 << 20) {
  return run_child({"/bin/sh", "-c", script}, seconds, most);
}
std::string text(const ChildResult& r) {
  return {reinterpret_cast<const char*>(r.output.data()), r.output.size()};
}

TEST(RunChild, CollectsOutputAndExitCode) {
  const ChildResult r = shell("echo out; echo err >&2; exit 7");
  EXPECT_EQ(text(r), "out\n");
  EXPECT_EQ(r.exit_code, 7);
  EXPECT_EQ(r.signal, 0);
}

TEST(RunChild, HasNothingToRead) {
  const ChildResult r = shell("cat; echo end");
  EXPECT_EQ(text(r), "end\n");
}

TEST(RunChild, SaysWhichSignalEndedIt) {
  const ChildResult r = shell("kill -SEGV $$");
  EXPECT_EQ(r.signal, SIGSEGV);
  EXPECT_FALSE(r.timed_out);
  EXPECT_EQ(signal_name(r.signal), "SIGSEGV");
}

TEST(RunChild, EndsAHangAtTheDeadline) {
  for (const char* script : {"while :; do :; done", "exec 1>&-; while :; do :; done"}) {
    const auto start = std::chrono::steady_clock::now();
    const ChildResult r = shell(script, 0.2);
    EXPECT_TRUE(r.timed_out);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  }
}

TEST(RunChild, EndsAFloodAtItsLimit) {
  const ChildResult r = shell("while :; do echo 0123456789; done", 10, 100'000);
  EXPECT_TRUE(r.too_much);
}

TEST(RunChild, MissingProgramIsASystemError) {
  EXPECT_THROW(run_child({"/nowhere/program"}, 1, 1), SystemError);
}

TEST(RunChild, LeavesNoChildBehindAndServesThreads) {
  std::vector<std::thread> threads;
  std::vector<std::string> said(4);
  for (std::size_t i = 0; i < said.size(); ++i)
    threads.emplace_back([&said, i] {
      for (int k = 0; k < 5; ++k) said[i] += text(shell("echo " + std::to_string(i)));
    });
  for (std::thread& t : threads) t.join();
  for (std::size_t i = 0; i < said.size(); ++i) {
    const std::string once = std::to_string(i) + "\n";
    EXPECT_EQ(said[i], once + once + once + once + once);
  }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // no children
}

}  // namespace
}  // namespace packbed
