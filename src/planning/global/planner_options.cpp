#include "planning/global/planner_options.h"

namespace mocha {

PlannerOptions PlannerOptions::from(const ParameterTable& values) {
  PlannerOptions options;
  static_cast<DriveOptions&>(options) = DriveOptions::from(values);
  options.weight_duration = values.number("weight_duration");
  options.open_knot_spacing_m = values.number("open_knot_spacing");
  options.preferred_clearance_m = values.number("preferred_clearance");
  options.clearance_weight = values.number("clearance_weight");
  options.smooth_start_rad = values.number("smooth_start");
  options.goal_search_radius_m = values.number("goal_search_radius");
  options.roadmap = roadmap_kind(values.text("roadmap"));
  options.prm_samples = values.integer("prm_samples");
  options.classes = values.integer("classes");
  options.longest_ratio = values.number("longest_ratio");
  options.switch_margin = values.number("switch_margin");
  options.threads = values.integer("planning_threads");
  return options;
}

}  // namespace mocha
