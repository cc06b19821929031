#pragma once

#include "config/parameter_table.h"

namespace mocha {

/// Limits of a robot that moves in space, and weights and sizes of its planning; each stands with
/// unit, range and default in config/space_planner.yaml.
struct SpacePlannerOptions {
  double radius_m;  ///< of the ball that holds the robot
  double margin_m;  ///< proved beyond it
  double max_speed;
  double max_acceleration;
  double weight_effort;
  double weight_duration;
  double weight_obstacle;
  double weight_moving;
  double weight_dynamics;
  int samples_per_piece;
  double knot_spacing_m;
  double open_knot_spacing_m;
  double knot_travel_m;
  double soft_margin_m;
  int max_evaluations;
  int classes;
  double longest_ratio;
  int prm_samples;
  double prm_reach_m;
  double planning_time_s;
  int threads;

  double required_clearance_m() const { return radius_m + margin_m; }

  static SpacePlannerOptions from(const ParameterTable& values);
};

}  // namespace mocha
