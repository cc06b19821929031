#pragma once

#include "planning/drive_rules.h"
#include "topology/ways.h"

namespace mocha {

/// Weights and sizes of global planning; each stands with unit, range and default in
/// config/global_planner.yaml.
struct PlannerRules : DriveRules {
  double preferred_clearance_m;
  double clearance_weight;
  double smooth_start_rad;
  double goal_search_radius_m;
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
