#pragma once

#include "trajectory/arc.h"
#include "world/robot_model.h"

namespace mocha {

/// How a differential drive moves: forward speed [m/s] and yaw rate [rad/s].
struct Twist {
  double speed = 0.0;
  double yaw_rate = 0.0;
};

/// A differential drive: commands become wheel speeds, which follow with a first-order lag within
/// the wheels' limits; backward only where the model can. Nothing stops it but its wheels:
/// obstacles do not push back.
class Vehicle {
 public:
  Vehicle(const RobotModel& model, const Pose& start);

  /// Takes a command at time `now_s` [s]. Throws std::invalid_argument unless both values are
  /// finite.
  void command(double now_s, const Twist& twist);

  /// Moves on from `now_s` by `dt_s`. A command older than the model's limit counts as zero.
  Arc step(double now_s, double dt_s);

  const Pose& pose() const { return pose_; }
  Twist twist() const;
  double acceleration() const {
    return acceleration_;
  }  ///< [m/s^2] along the heading, in the last step

 private:
  struct Wheels {
    double left = 0.0;  ///< [m/s] rim
    double right = 0.0;
  };

  Wheels wanted(double now_s) const;
  double followed(double speed, double wanted, double dt_s) const;

  double max_wheel_speed_;
  double max_wheel_acceleration_;
  double track_m_;
  bool can_reverse_;
  double lag_s_;
  double cmd_timeout_s_;
  Pose pose_;
  Wheels wheels_;
  double acceleration_ = 0.0;
  Twist command_;
  double command_time_s_;
};

}  // namespace mocha
