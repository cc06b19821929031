#pragma once

#include "config/parameter_table.h"

namespace mocha {

/// Weights and sizes of the optimisation of a drive, paper (14). Each stands with unit, range and
/// default in the config of the node that plans.
struct DriveOptions {
  double weight_effort;
  double weight_obstacle;
  double weight_dynamics;
  double weight_turning;
  double weight_moving;
  int samples_per_piece;
  double knot_spacing_m;  ///< of knots at full speed
  /// The same where there is plenty of room, on paths without times.
  double open_knot_spacing_m;
  double knot_travel_m;
  double soft_margin_m;
  double moving_soft_margin_m;
  int max_evaluations;

  static DriveOptions from(const ParameterTable& values);
};

}  // namespace mocha
