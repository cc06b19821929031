#pragma once

#include "planning/candidates/drive_options.h"
#include "topology/paths/homotopy_paths.h"

namespace mocha {

/// Weights and sizes of global planning; each stands with unit, range and default in
/// config/global_planner.yaml.
struct PlannerOptions : DriveOptions {
  double weight_duration;
  double preferred_clearance_m;
  double clearance_weight;
  double smooth_start_rad;
  double goal_search_radius_m;
  RoadmapKind roadmap;
  int prm_samples;
  int classes;
  double longest_ratio;
  double switch_margin;
  int threads;

  static PlannerOptions from(const ParameterTable& values);
};

}  // namespace mocha
