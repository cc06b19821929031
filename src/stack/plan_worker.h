#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "stack/plan_runner.h"

namespace mocha {

/// Makes plans on a thread of its own; the caller is never kept waiting.
class PlanWorker : public PlanRunner {
 public:
  struct Hooks {
    /// Time that passes whatever is simulated [s]; it is called on both threads.
    std::function<double()> now_s;
    /// Called on the worker's thread when an answer is there.
    std::function<void()> answered;
    /// Whether time limits are held to. Else a plan takes as long as its work does, so that it is
    /// the same on each machine.
    bool limits_time;
  };

  explicit PlanWorker(Hooks hooks);
  /// Stops what is under way, and waits for that.
  ~PlanWorker() override;
  PlanWorker(const PlanWorker&) = delete;
  PlanWorker& operator=(const PlanWorker&) = delete;

  void begin(Work work, double time_limit_s) override;
  std::optional<PlanResult> answer() override;
  /// Whether what was begun last is under way.
  bool busy() const;

 private:
  struct Task {
    Work work;
    double begun_s;
    double until_s;
    std::atomic<bool> given_up{false};  // another one was begun, or the worker ends
  };

  void give_up();
  void run();
  PlanResult result_of(const Task& task) const;
  void finish(const std::shared_ptr<Task>& task, PlanResult result);

  const Hooks hooks_;
  mutable std::mutex mutex_;  // of all that follows
  std::condition_variable changed_;
  bool ends_ = false;
  std::shared_ptr<Task> waiting_;  // for the thread to begin it
  std::shared_ptr<Task> task_;     // begun last, while its answer is wanted
  std::optional<PlanResult> answer_;
  std::thread thread_;
};

}  // namespace mocha
