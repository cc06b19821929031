#include "planning/drive_rules.h"

namespace mocha {

DriveRules DriveRules::from(const ParameterTable& values) {
  DriveRules rules;
  rules.weight_effort = values.number("weight_effort");
  rules.weight_duration = values.number("weight_duration");
  rules.weight_obstacle = values.number("weight_obstacle");
  rules.weight_dynamics = values.number("weight_dynamics");
  rules.weight_turning = values.number("weight_turning");
  rules.weight_moving = values.number("weight_moving");
  rules.samples_per_piece = values.integer("samples_per_piece");
  rules.knot_spacing_m = values.number("knot_spacing");
  rules.knot_travel_m = values.number("knot_travel");
  rules.soft_margin_m = values.number("soft_margin");
  rules.moving_soft_margin_m = values.number("moving_soft_margin");
  rules.max_evaluations = values.integer("max_evaluations");
  return rules;
}

}  // namespace mocha
