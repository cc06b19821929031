#include "planning/local_rules.h"

namespace mocha {

LocalRules LocalRules::from(const ParameterTable& values) {
  LocalRules rules;
  static_cast<DriveRules&>(rules) = DriveRules::from(values);
  rules.mu_s = values.number("anchor_horizon");
  rules.t_epsilon_s = values.number("longest_local_drive");
  rules.samples = values.integer("samples");
  rules.classes = values.integer("classes");
  rules.longest_ratio = values.number("longest_ratio");
  rules.switch_margin = values.number("switch_margin");
  rules.switch_gain = values.number("switch_gain");
  rules.smooth_start_rad = values.number("smooth_start");
  rules.threads = values.integer("planning_threads");
  return rules;
}

}  // namespace mocha
