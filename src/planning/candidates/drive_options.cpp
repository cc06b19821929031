#include "planning/candidates/drive_options.h"

namespace mocha {

DriveOptions DriveOptions::from(const ParameterTable& values) {
  DriveOptions options;
  options.weight_effort = values.number("weight_effort");
  options.weight_obstacle = values.number("weight_obstacle");
  options.weight_dynamics = values.number("weight_dynamics");
  options.weight_turning = values.number("weight_turning");
  options.weight_moving = values.number("weight_moving");
  options.samples_per_piece = values.integer("samples_per_piece");
  options.knot_spacing_m = values.number("knot_spacing");
  options.knot_travel_m = values.number("knot_travel");
  options.soft_margin_m = values.number("soft_margin");
  options.moving_soft_margin_m = values.number("moving_soft_margin");
  options.max_evaluations = values.integer("max_evaluations");
  return options;
}

}  // namespace mocha
