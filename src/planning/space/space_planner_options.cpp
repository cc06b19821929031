#include "planning/space/space_planner_options.h"

namespace mocha {

SpacePlannerOptions SpacePlannerOptions::from(const ParameterTable& values) {
  SpacePlannerOptions options;
  options.radius_m = values.number("radius");
  options.margin_m = values.number("margin");
  options.max_speed = values.number("max_speed");
  options.max_acceleration = values.number("max_acceleration");
  options.weight_effort = values.number("weight_effort");
  options.weight_duration = values.number("weight_duration");
  options.weight_obstacle = values.number("weight_obstacle");
  options.weight_moving = values.number("weight_moving");
  options.weight_dynamics = values.number("weight_dynamics");
  options.samples_per_piece = values.integer("samples_per_piece");
  options.knot_spacing_m = values.number("knot_spacing");
  options.open_knot_spacing_m = values.number("open_knot_spacing");
  options.knot_travel_m = values.number("knot_travel");
  options.soft_margin_m = values.number("soft_margin");
  options.max_evaluations = values.integer("max_evaluations");
  options.classes = values.integer("classes");
  options.longest_ratio = values.number("longest_ratio");
  options.prm_samples = values.integer("prm_samples");
  options.prm_reach_m = values.number("prm_reach");
  options.planning_time_s = values.number("planning_time");
  options.threads = values.integer("planning_threads");
  return options;
}

}  // namespace mocha
