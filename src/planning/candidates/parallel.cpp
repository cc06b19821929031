#include "planning/candidates/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

namespace mocha {

void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  const int cores = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, cores) : cores);
  std::atomic<std::size_t> next{0};
  arena.execute([&] {
    // One at a time each, so that they are begun in order.
    tbb::parallel_for(
        std::size_t{0}, count, [&](std::size_t) { work(next++); }, tbb::simple_partitioner());
  });
}

}  // namespace mocha
