#include "trajectory/unicycle.h"

#include "trajectory/plane_vectors.h"

namespace mocha {

UnicycleState unicycle_state(int direction, const Eigen::Vector2d& velocity,
                             const Eigen::Vector2d& acceleration, const Eigen::Vector2d& jerk,
                             const Eigen::Vector2d& snap) {
  constexpr double kRestSpeed = 1e-6;         // below, the velocity's direction is rounding noise
  constexpr double kRestAcceleration = 1e-3;  // likewise
  constexpr double kRestJerk = 1e-3;
  const double speed = velocity.norm();
  if (speed > kRestSpeed) {
    return {direction * speed, cross(velocity, acceleration) / velocity.squaredNorm()};
  }
  // Limits of (v x a) / |v|^2 as v -> 0 along the curve, by expanding both to the first order that
  // does not vanish.
  if (acceleration.norm() > kRestAcceleration) {
    return {direction * speed, cross(acceleration, jerk) / (2.0 * acceleration.squaredNorm())};
  }
  if (jerk.norm() > kRestJerk) {
    return {direction * speed, cross(jerk, snap) / (3.0 * jerk.squaredNorm())};
  }
  return {direction * speed, 0.0};
}

WheelSpeeds wheel_speeds(const UnicycleState& state, double track_m) {
  const double difference = 0.5 * track_m * state.yaw_rate;
  return {state.speed - difference, state.speed + difference};
}

UnicycleState from_wheel_speeds(const WheelSpeeds& wheels, double track_m) {
  return {0.5 * (wheels.left + wheels.right), (wheels.right - wheels.left) / track_m};
}

}  // namespace mocha
