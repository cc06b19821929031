#pragma once

#include <limits>

namespace mocha {

/// [m/s] Slower is rest.
constexpr double kRest_mps = 1e-3;
/// Longest time from the present acceleration to the deceleration.
constexpr double kBrakingRamp_s = 0.2;

/// How hard a robot brakes: at a deceleration, and in a bend at what the friction circle leaves.
class Braking {
 public:
  /// `deceleration` [m/s^2]: along the path, at most. `max_acceleration` [m/s^2]: along and across
  /// the path together; without it, bends change nothing. `yaw_deceleration` [rad/s^2]: of turns in
  /// place; peers are not told it, as it moves no disc. Throws std::invalid_argument for
  /// decelerations that are not positive and finite, and a limit that is not positive.
  explicit Braking(double deceleration,
                   double max_acceleration = std::numeric_limits<double>::infinity(),
                   double yaw_deceleration = 1.0);

  double deceleration() const { return deceleration_; }
  double max_acceleration() const { return max_acceleration_; }
  double yaw_deceleration() const { return yaw_deceleration_; }

  /// What is left for braking beside `lateral` [m/s^2] across the path; at least a quarter of the
  /// deceleration, so that the robot slows down in the sharpest bend, too.
  double beside(double lateral) const;

  /// How the speed changes [m/s^2] where the acceleration along the path was `initial` and the ramp
  /// to the deceleration is done to the share `ramped`, from 0 to 1.
  double rate(double initial, double ramped, double lateral) const {
    return initial + ramped * (-beside(lateral) - initial);
  }

 private:
  double deceleration_;
  double max_acceleration_;
  double yaw_deceleration_;
};

}  // namespace mocha
