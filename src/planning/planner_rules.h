#pragma once

#include "config/parameter_table.h"
#include "topology/ways.h"

namespace mocha {

/// Weights and sizes of global planning; each stands with unit, range and default in
/// config/global_planner.yaml.
struct PlannerRules {
  double weight_effort;
  double weight_duration;
  double weight_obstacle;
  double weight_dynamics;
  double weight_turning;
  double weight_moving;
  int samples_per_piece;
  double knot_spacing_m;
  double open_knot_spacing_m;
  double knot_travel_m;
  double soft_margin_m;
  double preferred_clearance_m;
  double clearance_weight;
  int max_evaluations;
  double smooth_start_rad;
  double goal_search_radius_m;
  double peer_soft_margin_m;
  double back_out_m;
  RoadmapKind roadmap;
  int prm_samples;
  int classes;
  double longest_ratio;
  double switch_margin;
  int threads;

  static PlannerRules from(const ParameterTable& values);
};

}  // namespace mocha
