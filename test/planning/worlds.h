#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "config/parameter_table.h"
#include "planning/candidates/local_scene.h"
#include "planning/global/planner_options.h"
#include "planning/local/local_options.h"
#include "planning/local/local_plan.h"
#include "topology/grid_world.h"
#include "trajectory/simple_motions.h"
#include "world/moving/moving_obstacle.h"
#include "world/robot_model.h"

namespace mocha {

constexpr double kForever_s = std::numeric_limits<double>::infinity();

inline RobotModel rover() { return load_robot_model("config", "rover"); }
inline RobotModel jackal() { return load_robot_model("config", "jackal"); }

inline PlannerOptions default_options() {
  return PlannerOptions::from(ParameterTable::from_schema("config/global_planner.yaml"));
}

inline LocalOptions default_local_options() {
  return LocalOptions::from(ParameterTable::from_schema("config/local_replanner.yaml"));
}

/// What is known of a grid; nothing moves.
inline LocalScene scene_of(const OccupancyGrid& grid) {
  return local_scene(static_map_of(grid), unseen_field(grid));
}

}  // namespace mocha
