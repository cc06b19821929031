#pragma once

#include "trajectory/unicycle.h"
#include "world/robot_model.h"

namespace mocha {

/// Keeps commands within what the wheels of the base can do. It remembers the last command.
class CommandLimiter {
 public:
  explicit CommandLimiter(const RobotModel& robot);

  /// The command closest to `wanted` that the wheels can follow `dt` [s] after the last. Where the
  /// wheels are too slow for both, the yaw rate is kept and the speed gives way, so that the robot
  /// stays on its path.
  UnicycleState limit(const UnicycleState& wanted, double dt);

  /// One step of a stop within the planned acceleration that keeps the curvature of the last
  /// command.
  UnicycleState ramp_down(double dt);

  /// One step of a stop that straightens out at once: the yaw rate falls as fast as the wheels
  /// allow.
  UnicycleState ramp_down_straight(double dt);

  const UnicycleState& last() const { return last_; }

 private:
  double max_wheel_speed_;
  double max_wheel_acceleration_;
  double track_m_;
  bool can_reverse_;
  double deceleration_;
  double yaw_deceleration_;
  UnicycleState last_ = {0.0, 0.0};
};

}  // namespace mocha
