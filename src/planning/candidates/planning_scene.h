#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "topology/static_map/static_map.h"
#include "trajectory/motion.h"
#include "world/moving/moving_obstacle.h"
#include "world/speed_zones.h"

namespace mocha {

/// What is around: the static obstacles (unknown space counts as free) and the team-mates.
struct PlanningScene {
  std::shared_ptr<const StaticMap> static_map;
  std::vector<std::shared_ptr<const MovingObstacle>> peers;
  /// Makes the field of what was not seen free, for a robot that sets off; empty: all was seen.
  std::function<std::shared_ptr<const ObstacleField<2>>()> unseen = {};
  std::shared_ptr<const SpeedZones> speed_zones = {};  ///< null: none
};

/// From where, from when and to where. Map frame, absolute times.
struct PlanQuery {
  double start_time_s = 0.0;
  /// What the robot is bound to do; the plan joins it at start_time_s (a switch time of the
  /// motion).
  Motion committed;
  Vector2 goal = Vector2::Zero();
  std::optional<double> goal_yaw_rad;
  /// The one path to the goal that is to be driven, from where the robot is or was on it; empty:
  /// any.
  std::vector<Vector2> along;
  /// The plan to the same goal that is being driven, for its class; empty if there is none.
  Motion driven;
  /// How long planning may take [s]: as work (see GlobalPlanner), and as time where somebody stops
  /// it then.
  double time_limit_s = std::numeric_limits<double>::infinity();
  /// Ends planning early; several threads may call it at once.
  std::function<bool()> should_stop = [] { return false; };
};

}  // namespace mocha
