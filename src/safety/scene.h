#pragma once

#include <memory>
#include <vector>

#include "world/moving/moving_obstacle.h"
#include "world/obstacle_field.h"
#include "world/speed_zones.h"

namespace mocha {

/// What is around a robot, as far as a motion is certified against it. Map frame, absolute times.
struct Scene {
  std::shared_ptr<const ObstacleField<2>> obstacles;  ///< occupied space
  /// Space that is occupied or was never seen; null where no requirement asks for it.
  std::shared_ptr<const ObstacleField<2>> unseen;
  std::vector<std::shared_ptr<const MovingObstacle>> peers = {};  ///< on their promises
  /// Things that promise nothing: discs that hold them with the confidence that is asked for ...
  std::vector<std::shared_ptr<const MovingObstacle>> confident = {};
  /// ... and discs on their most likely course; empty where `confident` stands for both.
  std::vector<std::shared_ptr<const MovingObstacle>> likely = {};
  double predicted_until_s = 0.0;                      ///< later, predictions say nothing
  std::shared_ptr<const SpeedZones> speed_zones = {};  ///< null: none
};

}  // namespace mocha
