#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace mocha {

/// Runs calls that may take long on a thread of its own, one after the other, so that a robot that
/// does not answer does not hold the window up.
class BackgroundCalls {
 public:
  BackgroundCalls();
  /// Waits for the call that runs; those that wait are dropped.
  ~BackgroundCalls();

  void add(std::function<void()> call);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace mocha
