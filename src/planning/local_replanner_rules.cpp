#include "planning/local_replanner_rules.h"

namespace mocha {

LocalReplannerRules LocalReplannerRules::from(const ParameterTable& values,
                                              const RobotModel& robot) {
  LocalReplannerRules rules;
  rules.settle_s = values.number("settle_time");
  rules.emergency_s = values.number("emergency_time");
  rules.horizon_s = values.number("horizon");
  rules.extend_every_s = values.number("extend_every");
  rules.answer_timeout_s = values.number("answer_timeout");
  // The tracker brakes at e_track; a little later the promise itself is given up.
  rules.max_error_m = 1.5 * robot.margins.tracking_m;
  rules.max_error_rad = values.number("max_heading_error");
  rules.mu_pre_s = values.number("trigger_horizon");
  return rules;
}

}  // namespace mocha
