#include "planning/planner_rules.h"

namespace mocha {

PlannerRules PlannerRules::from(const ParameterTable& values) {
  PlannerRules rules;
  rules.weight_effort = values.number("weight_effort");
  rules.weight_duration = values.number("weight_duration");
  rules.weight_obstacle = values.number("weight_obstacle");
  rules.weight_dynamics = values.number("weight_dynamics");
  rules.weight_turning = values.number("weight_turning");
  rules.weight_moving = values.number("weight_moving");
  rules.samples_per_piece = values.integer("samples_per_piece");
  rules.knot_spacing_m = values.number("knot_spacing");
  rules.open_knot_spacing_m = values.number("open_knot_spacing");
  rules.knot_travel_m = values.number("knot_travel");
  rules.soft_margin_m = values.number("soft_margin");
  rules.preferred_clearance_m = values.number("preferred_clearance");
  rules.clearance_weight = values.number("clearance_weight");
  rules.max_evaluations = values.integer("max_evaluations");
  rules.smooth_start_rad = values.number("smooth_start");
  rules.goal_search_radius_m = values.number("goal_search_radius");
  rules.peer_soft_margin_m = values.number("peer_soft_margin");
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
