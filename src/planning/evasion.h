#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "trajectory/motion.h"
#include "world/moving_obstacle.h"
#include "world/obstacle_field.h"
#include "world/robot_model.h"

namespace mocha {

/// What a robot that steps aside has to look out for.
struct EvasionScene {
  const ObstacleField<2>& obstacles;
  double required_clearance_m;  ///< of the robot's centre, to obstacles
  std::vector<MovingThing> moving;
  double until_s;  ///< it should be out of the way until then
};

/// Motions that brake where need be and then step aside, out of the way of what moves, to rest: a
/// turn in place and a straight drive, forward or backward, to a place within two metres that stays
/// free. The most promising first, some ten of them at most; they keep the robot's limits, all else
/// is for the caller to prove.
std::vector<Motion> evasions(const Motion& committed, double start_time_s, double deceleration,
                             const RobotModel& robot, const EvasionScene& scene);

}  // namespace mocha
