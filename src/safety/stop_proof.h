#pragma once

#include "safety/violation.h"
#include "trajectory/stop_separation.h"
#include "world/moving/moving_obstacle.h"

namespace mocha {

/// How a robot and its peers stop for each other.
struct StopOptions {
  Braking braking;    ///< of the robot; every peer says how it brakes itself
  double reaction_s;  ///< from the moment at which the one brakes until the other does
};

/// From `from_s` (absolute) on, either robot may brake along its path at any moment, and the other
/// after the reaction time: their discs keep `clearance_m`, as first_stop_meeting() proves it. A
/// robot that is closer at `from_s` may move as long as its stops come no closer. The violation's
/// time is the first at which one of them must not brake, its value and limit are between the
/// discs [m]. An obstacle that promises no motion violates nothing.
Violation check_stops(const Motion& motion, double own_radius_m, const MovingObstacle& peer,
                      double clearance_m, const StopOptions& options, double from_s);

}  // namespace mocha
