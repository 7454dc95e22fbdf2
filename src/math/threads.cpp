#include "math/threads.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>

namespace packbed {
namespace {
int thread_count = 1;
std::unique_ptr<tbb::global_control> limit;  // lets TBB start more workers than the machine has cores
std::unique_ptr<tbb::task_arena> arena;
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
  if (n == 0) return;
  if (!arena || n <= grain) {
    body(0, n);
    return;
  }
  arena->execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, n, std::max<std::size_t>(1, grain)),
        [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); },
        tbb::static_partitioner());
  });
}

}  // namespace packbed
