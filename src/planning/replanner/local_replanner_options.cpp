#include "planning/replanner/local_replanner_options.h"

#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kAnswerSlack_s = 0.3;  // beyond the time by which a proposal is binding or refused
constexpr double kLater = 1.5;          // than the tracker, in errors

}  // namespace

LocalReplannerOptions LocalReplannerOptions::from(const ParameterTable& values,
                                                  const RobotModel& robot, double promise_reach_m) {
  LocalReplannerOptions options;
  options.settle_s = values.number("settle_time");
  options.emergency_s = values.number("emergency_time");
  options.horizon_s = values.number("horizon");
  options.extend_every_s = values.number("extend_every");
  options.answer_timeout_s = options.settle_s + kAnswerSlack_s;
  // The tracker brakes at e_track; a little later the promise itself is given up.
  const SpeedMargin tracking = MarginBudget::of(robot).tracking();
  options.max_error = {kLater * tracking.still_m, kLater * tracking.per_speed2};
  options.max_standing_error_m = options.max_error.at(robot.limits.max_speed);
  options.max_error_rad = values.number("max_heading_error");
  options.mu_pre_s = values.number("trigger_horizon");
  options.promise_reach_m = promise_reach_m;
  return options;
}

}  // namespace mocha
