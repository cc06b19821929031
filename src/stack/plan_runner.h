#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "planning/candidates/plan_result.h"

namespace mocha {

/// Where plans are made, one at a time.
class PlanRunner {
 public:
  /// Makes a plan, or, as soon as `should_stop`, what it has by then.
  using Work = std::function<PlanResult(const std::function<bool()>& should_stop)>;

  virtual ~PlanRunner() = default;
  /// Begins to plan, for `time_limit_s` at most where time is what counts. What was begun before is
  /// given up.
  virtual void begin(Work work, double time_limit_s) = 0;
  /// What was begun last came to this; once, and nothing while it is under way.
  virtual std::optional<PlanResult> answer() = 0;
};

/// Plans at once, where it is asked to.
class InlinePlanRunner : public PlanRunner {
 public:
  void begin(Work work, double) override {
    answer_ = work([] { return false; });
  }
  std::optional<PlanResult> answer() override { return std::exchange(answer_, std::nullopt); }

 private:
  std::optional<PlanResult> answer_;
};

}  // namespace mocha
