#pragma once

#include <Eigen/Core>

namespace mocha {

/// Speed and yaw rate of a differential-drive robot whose flat output is the position of its base,
/// paper (2)(3).
struct UnicycleState {
  double speed;     ///< [m/s] along the heading; negative backward
  double yaw_rate;  ///< [rad/s]
};

/// Left and right wheel rim speeds [m/s].
struct WheelSpeeds {
  double left;
  double right;
};

/// `direction` is +1 forward, -1 backward. Safe at standstill, where the yaw rate follows from the
/// highest derivative that does not vanish: velocity [m/s], acceleration [m/s^2], jerk [m/s^3],
/// snap [m/s^4].
UnicycleState unicycle_state(int direction, const Eigen::Vector2d& velocity,
                             const Eigen::Vector2d& acceleration, const Eigen::Vector2d& jerk,
                             const Eigen::Vector2d& snap);

/// `track_m` is the distance between the wheels.
WheelSpeeds wheel_speeds(const UnicycleState& state, double track_m);
UnicycleState from_wheel_speeds(const WheelSpeeds& wheels, double track_m);

}  // namespace mocha
