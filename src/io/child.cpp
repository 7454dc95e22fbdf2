#include "io/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "math/error.hpp"

extern char** environ;

namespace packbed {
namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw SystemError(fmt::format("no pipe to a child: {}", std::strerror(errno)));
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    close_write();
    ::close(read);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_write() {
    if (write >= 0) ::close(write);
    write = -1;
  }
};

struct Actions {
  posix_spawn_file_actions_t list;
  Actions() { posix_spawn_file_actions_init(&list); }
  ~Actions() { posix_spawn_file_actions_destroy(&list); }
};

pid_t spawn(const std::vector<std::string>& argv, int output) {
  Actions actions;
  posix_spawn_file_actions_addopen(&actions.list, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions.list, output, 1);
  posix_spawn_file_actions_addopen(&actions.list, 2, "/dev/null", O_WRONLY, 0);
  std::vector<char*> args;
  for (const std::string& a : argv) args.push_back(const_cast<char*>(a.c_str()));
  args.push_back(nullptr);
  pid_t pid = 0;
  const int error = ::posix_spawn(&pid, args[0], &actions.list, nullptr, args.data(), environ);
  if (error != 0) throw SystemError(fmt::format("cannot start {}: {}", argv[0], std::strerror(error)));
  return pid;
}

int milliseconds_left(Clock::time_point deadline) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<long long>(left, 0, 60'000));
}

// Reads to the end of the pipe, the deadline or the limit, whichever comes first.
void collect(int from, Clock::time_point deadline, std::size_t largest, ChildResult& result) {
  std::byte buffer[1 << 16];
  while (true) {
    if (Clock::now() >= deadline) {
      result.timed_out = true;
      return;
    }
    pollfd watched{from, POLLIN, 0};
    if (::poll(&watched, 1, milliseconds_left(deadline)) <= 0) continue;
    const ssize_t n = ::read(from, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    result.output.insert(result.output.end(), buffer, buffer + n);
    if (result.output.size() > largest) {
      result.too_much = true;
      return;
    }
  }
}

// Its output is closed: it is ending. Waits until the deadline, then ends it.
void reap(pid_t pid, Clock::time_point deadline, ChildResult& result) {
  int status = 0;
  const bool stop = result.timed_out || result.too_much;
  if (stop) ::kill(pid, SIGKILL);
  auto nap = std::chrono::microseconds(100);
  while (true) {
    const pid_t ended = ::waitpid(pid, &status, stop ? 0 : WNOHANG);
    if (ended == pid) break;
    if (ended < 0 && errno != EINTR) return;
    if (!stop && Clock::now() >= deadline) {
      result.timed_out = true;
      return reap(pid, deadline, result);
    }
    std::this_thread::sleep_for(nap);
    nap = std::min<std::chrono::microseconds>(2 * nap, std::chrono::milliseconds(5));
  }
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status) && !stop) result.signal = WTERMSIG(status);
}

}  // namespace

ChildResult run_child(const std::vector<std::string>& argv, double seconds, std::size_t largest_output) {
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  Pipe pipe;
  const pid_t pid = spawn(argv, pipe.write);
  pipe.close_write();
  ChildResult result;
  try {
    collect(pipe.read, deadline, largest_output, result);
  } catch (...) {  // no memory for the output: leave no child behind
    result.too_much = true;
    reap(pid, deadline, result);
    throw;
  }
  reap(pid, deadline, result);
  return result;
}

std::string signal_name(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "SIGSEGV";
    case SIGABRT:
      return "SIGABRT";
    case SIGBUS:
      return "SIGBUS";
    case SIGFPE:
      return "SIGFPE";
    case SIGILL:
      return "SIGILL";
    case SIGKILL:
      return "SIGKILL";
    case SIGXCPU:
      return "SIGXCPU";
    default:
      return fmt::format("signal {}", signal);
  }
}

}  // namespace packbed
