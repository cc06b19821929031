#pragma once

#include "tbb/info.h"

namespace tbb {
namespace detail {

/// That a loop of this thread may use.
inline int& most_threads() {
  thread_local int most = info::default_concurrency();
  return most;
}

}  // namespace detail

class task_arena {
 public:
  explicit task_arena(int most_threads) : most_threads_(most_threads) {}

  template <class Work>
  void execute(const Work& work) {
    const Limit limit(most_threads_);
    work();
  }

 private:
  struct Limit {
    explicit Limit(int most_threads) : before(detail::most_threads()) {
      detail::most_threads() = most_threads;
    }
    ~Limit() { detail::most_threads() = before; }

    int before;
  };

  int most_threads_;
};

}  // namespace tbb
