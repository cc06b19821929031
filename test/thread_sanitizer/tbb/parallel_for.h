#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "tbb/task_arena.h"

/// As much of TBB as the core uses, on threads of the standard library. Debian's TBB is not built
/// for the thread sanitizer, which then takes all that it hands from thread to thread for races.
namespace tbb {

struct simple_partitioner {};

template <class Index, class Body>
void parallel_for(Index begin, Index end, const Body& body, const simple_partitioner& = {}) {
  std::atomic<Index> next{begin};
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto work = [&] {
    try {
      for (Index i = next++; i < end; i = next++) body(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!thrown) thrown = std::current_exception();
      next = end;
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < detail::most_threads(); ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace tbb
