#include "stack/plan_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <stdexcept>

namespace mocha {
namespace {

using ShouldStop = std::function<bool()>;
constexpr auto kPatience = std::chrono::seconds(60);

PlanResult named(const std::string& name) {
  PlanResult result;
  result.message = name;
  return result;
}

/// Works until it is told to stop.
PlanResult endless(const ShouldStop& should_stop) {
  while (!should_stop()) std::this_thread::yield();
  return named("stopped");
}

/// A worker whose clock stands where it is set.
class PlanWorkerTest : public ::testing::Test {
 protected:
  void wait_for_answers(int count) {
    std::unique_lock<std::mutex> lock(mutex_);
    ASSERT_TRUE(changed_.wait_for(lock, kPatience, [&] { return answers_ >= count; }));
  }

  PlanWorker::Hooks hooks(bool limits_time) {
    return {[this] { return now_s_.load(); },
            [this] {
              const std::lock_guard<std::mutex> lock(mutex_);
              ++answers_;
              changed_.notify_all();
            },
            limits_time};
  }

  std::atomic<double> now_s_{10.0};
  std::mutex mutex_;
  std::condition_variable changed_;
  int answers_ = 0;
};

TEST_F(PlanWorkerTest, AnswersOnceAndSaysHowLongItTook) {
  PlanWorker worker(hooks(true));
  EXPECT_FALSE(worker.answer());
  worker.begin(
      [&](const ShouldStop&) {
        now_s_ = 10.25;
        return named("plan");
      },
      1.0);
  wait_for_answers(1);
  const auto answer = worker.answer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->message, "plan");
  EXPECT_DOUBLE_EQ(answer->took_s, 0.25);
  EXPECT_FALSE(worker.answer());
}

TEST_F(PlanWorkerTest, DoesNotKeepItsCallerWaiting) {
  PlanWorker worker(hooks(true));
  std::promise<void> go;
  worker.begin(
      [&](const ShouldStop&) {
        go.get_future().wait();
        return named("plan");
      },
      1.0);
  EXPECT_FALSE(worker.answer());
  go.set_value();
  wait_for_answers(1);
  EXPECT_TRUE(worker.answer());
}

TEST_F(PlanWorkerTest, StopsWhenTheTimeIsUp) {
  PlanWorker worker(hooks(true));
  worker.begin(endless, 0.5);
  now_s_ = 10.4;
  EXPECT_FALSE(worker.answer());
  now_s_ = 10.6;
  wait_for_answers(1);
  EXPECT_EQ(worker.answer()->message, "stopped");
}

TEST_F(PlanWorkerTest, WhereWorkCountsNoTimeIsUp) {
  PlanWorker worker(hooks(false));
  std::atomic<bool> asked{false};
  std::promise<void> go;
  worker.begin(
      [&](const ShouldStop& should_stop) {
        go.get_future().wait();
        asked = should_stop();
        return named("plan");
      },
      0.5);
  now_s_ = 1e6;
  go.set_value();
  wait_for_answers(1);
  EXPECT_FALSE(asked);
}

TEST_F(PlanWorkerTest, GivesUpWhatWasBegunBefore) {
  PlanWorker worker(hooks(true));
  worker.begin(endless, 1.0);
  worker.begin([](const ShouldStop&) { return named("second"); }, 1.0);
  wait_for_answers(1);
  EXPECT_EQ(worker.answer()->message, "second");
  EXPECT_EQ(answers_, 1);
}

TEST_F(PlanWorkerTest, AnAnswerThatNobodyTookIsForgottenWithTheNextQuestion) {
  PlanWorker worker(hooks(true));
  worker.begin([](const ShouldStop&) { return named("first"); }, 1.0);
  wait_for_answers(1);
  worker.begin(endless, 1.0);
  EXPECT_FALSE(worker.answer());
}

TEST_F(PlanWorkerTest, SaysWhyPlanningFailed) {
  PlanWorker worker(hooks(true));
  worker.begin([](const ShouldStop&) -> PlanResult { throw std::length_error("too long"); }, 1.0);
  wait_for_answers(1);
  const auto answer = worker.answer();
  ASSERT_TRUE(answer);
  EXPECT_NE(answer->reason, PlanReason::kSolved);
  EXPECT_EQ(answer->message, "planning failed: too long");
}

TEST_F(PlanWorkerTest, EndsWhateverIsUnderWay) {
  PlanWorker worker(hooks(false));
  worker.begin(endless, 1.0);
  worker.begin(endless, 1.0);
}

}  // namespace
}  // namespace mocha
