#include "math/threads.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <thread>
#include <vector>

namespace packbed {
namespace {
int thread_count = 1;
std::unique_ptr<tbb::global_control> limit;  // lets TBB start more workers than the machine has cores
std::unique_ptr<tbb::task_arena> arena;

#ifdef __SANITIZE_THREAD__
// TBB's library is not built with the thread sanitizer, which then takes every hand-over between its workers
// for a race. Plain threads show the sanitizer what it is there to judge: whether two ranges touch the same
// data.
void run_ranges(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body,
                bool /*uneven*/) {
  const std::size_t ranges = std::min(static_cast<std::size_t>(thread_count), (n + grain - 1) / grain);
  std::vector<std::exception_ptr> failures(ranges);
  const auto run = [&](std::size_t r) {
    try {
      body(n * r / ranges, n * (r + 1) / ranges);
    } catch (...) {
      failures[r] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> workers;
    for (std::size_t r = 1; r < ranges; ++r) workers.emplace_back(run, r);
    run(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}
#else
void run_ranges(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body,
                bool uneven) {
  const tbb::blocked_range<std::size_t> all(0, n, grain);
  const auto run = [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); };
  arena->execute([&] {
    if (uneven)
      tbb::parallel_for(all, run, tbb::auto_partitioner());
    else
      tbb::parallel_for(all, run, tbb::static_partitioner());
  });
}
#endif

void run(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body,
         bool uneven) {
  if (n == 0) return;
  if (!arena || n <= grain)
    body(0, n);
  else
    run_ranges(n, std::max<std::size_t>(1, grain), body, uneven);
}
}  // namespace

void set_threads(int count) {
  thread_count = std::max(1, count);
  arena.reset();
  limit.reset();
  if (thread_count > 1) {
    limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(thread_count));
    arena = std::make_unique<tbb::task_arena>(thread_count);
  }
}

int threads() {
  return thread_count;
}

void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  run(n, grain, body, false);
}

void parallel_for_uneven(std::size_t n, std::size_t grain,
                         const std::function<void(std::size_t, std::size_t)>& body) {
  run(n, grain, body, true);
}

}  // namespace packbed
