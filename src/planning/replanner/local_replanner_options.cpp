#include "planning/replanner/local_replanner_options.h"

namespace mocha {
namespace {

constexpr double kAnswerSlack_s = 0.3;  // beyond the time by which a proposal is binding or refused

}  // namespace

LocalReplannerOptions LocalReplannerOptions::from(const ParameterTable& values,
                                                  const RobotModel& robot) {
  LocalReplannerOptions options;
  options.settle_s = values.number("settle_time");
  options.emergency_s = values.number("emergency_time");
  options.horizon_s = values.number("horizon");
  options.extend_every_s = values.number("extend_every");
  options.answer_timeout_s = options.settle_s + kAnswerSlack_s;
  // The tracker brakes at e_track; a little later the promise itself is given up.
  options.max_error_m = 1.5 * robot.margins.tracking_m;
  options.max_error_rad = values.number("max_heading_error");
  options.mu_pre_s = values.number("trigger_horizon");
  return options;
}

}  // namespace mocha
