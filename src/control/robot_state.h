#pragma once

#include "trajectory/motion.h"
#include "trajectory/unicycle.h"

namespace mocha {

/// Where a robot is and how it moves, as measured at `stamp_s`. Map frame.
struct RobotState {
  double stamp_s = 0.0;
  Pose pose;
  UnicycleState twist = {0.0, 0.0};
};

/// The pose at time t [s] if the robot goes on at the measured speed and yaw rate.
Pose predict(const RobotState& state, double t);

/// Whether the robot stands, as far as odometry can tell.
bool stands(const RobotState& state);

}  // namespace mocha
