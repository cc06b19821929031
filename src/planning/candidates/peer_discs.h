#pragma once

#include "topology/static_map/travel_cost.h"
#include "world/moving/moving_obstacle.h"
#include "world/robot_model.h"

namespace mocha {

/// Whether a team-mate that rests this soon after `t` [s] counts as standing: an obstacle with two
/// sides, to be driven around. One that moves is for the optimiser.
bool stands(const MovingObstacle& peer, double t);

/// Where the centre of the robot must not be because of a team-mate at time t, and `slack_m` more.
BlockedDisc peer_keep_out(const MovingObstacle& peer, double t, const RobotModel& robot,
                          double slack_m);

}  // namespace mocha
