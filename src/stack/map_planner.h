#pragma once

#include <memory>
#include <vector>

#include "planning/global/global_planner.h"
#include "world/goal.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// A robot that stands at `start`, promises nothing, and asks for a plan from time 0 on.
PlanQuery from_standing(const Pose& start, const Goal& goal);

/// What stands on a map, as planners see it, with room around the places. Throws
/// std::invalid_argument for a grid that is none.
std::shared_ptr<const StaticMap> static_map_of(const OccupancyGrid& map,
                                               const std::vector<Vector2>& places);

/// Plans on maps for one robot that has the place to itself. This is the entrance to the library
/// without fleet, lidar and ROS.
class MapPlanner {
 public:
  MapPlanner(const RobotModel& robot, const PlannerOptions& options) : planner_(robot, options) {}

  /// From rest to the goal, beginning at time 0, or why not. Throws std::invalid_argument for a
  /// grid that is none, or a start that is not finite.
  PlanResult plan(const OccupancyGrid& map, const Pose& start, const Goal& goal) const;

 private:
  const GlobalPlanner planner_;
};

}  // namespace mocha
