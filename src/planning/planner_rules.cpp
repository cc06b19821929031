#include "planning/planner_rules.h"

namespace mocha {

PlannerRules PlannerRules::from(const ParameterTable& values) {
  PlannerRules rules;
  static_cast<DriveRules&>(rules) = DriveRules::from(values);
  rules.open_knot_spacing_m = values.number("open_knot_spacing");
  rules.preferred_clearance_m = values.number("preferred_clearance");
  rules.clearance_weight = values.number("clearance_weight");
  rules.smooth_start_rad = values.number("smooth_start");
  rules.goal_search_radius_m = values.number("goal_search_radius");
  rules.back_out_m = values.number("back_out");
  rules.roadmap = roadmap_kind(values.text("roadmap"));
  rules.prm_samples = values.integer("prm_samples");
  rules.classes = values.integer("classes");
  rules.longest_ratio = values.number("longest_ratio");
  rules.switch_margin = values.number("switch_margin");
  rules.threads = values.integer("planning_threads");
  return rules;
}

}  // namespace mocha
