#include "stack/plan_worker.h"

#include <exception>
#include <limits>
#include <string>
#include <utility>

namespace mocha {

PlanWorker::PlanWorker(Hooks hooks) : hooks_(std::move(hooks)), thread_([this] { run(); }) {}

PlanWorker::~PlanWorker() {
  give_up();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void PlanWorker::begin(Work work, double time_limit_s) {
  give_up();
  const auto task = std::make_shared<Task>();
  task->work = std::move(work);
  task->begun_s = hooks_.now_s();
  task->until_s =
      hooks_.limits_time ? task->begun_s + time_limit_s : std::numeric_limits<double>::infinity();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_ = task_ = task;
  }
  changed_.notify_one();
}

std::optional<PlanResult> PlanWorker::answer() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(answer_, std::nullopt);
}

bool PlanWorker::busy() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return task_ != nullptr;
}

void PlanWorker::give_up() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (task_) task_->given_up = true;
  task_.reset();
  waiting_.reset();
  answer_.reset();
}

void PlanWorker::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ends_ || waiting_; });
    if (ends_) return;
    const std::shared_ptr<Task> task = std::exchange(waiting_, nullptr);
    lock.unlock();
    finish(task, result_of(*task));
    lock.lock();
  }
}

PlanResult PlanWorker::result_of(const Task& task) const {
  try {
    return task.work([&] { return task.given_up || hooks_.now_s() >= task.until_s; });
  } catch (const std::exception& error) {
    PlanResult failed;
    failed.reason = PlanReason::kNotCertified;
    failed.message = std::string("planning failed: ") + error.what();
    return failed;
  }
}

void PlanWorker::finish(const std::shared_ptr<Task>& task, PlanResult result) {
  result.took_s = hooks_.now_s() - task->begun_s;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (task != task_) return;
    task_.reset();
    answer_ = std::move(result);
  }
  hooks_.answered();
}

}  // namespace mocha
