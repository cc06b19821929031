#pragma once

#include <Eigen/Core>

#include "perception/localization/scan_matcher.h"
#include "world/robot_model.h"

namespace mocha {

/// How far off an odometry may be: a random walk over the distance and the turning, and wheels that
/// slip for a step.
class OdometryNoise {
 public:
  /// What every odometry has to be allowed.
  OdometryNoise() = default;

  /// Twice what the model says, as an odometry that is a little worse than that is not to mislead;
  /// at least what every odometry has to be allowed. `slip` is the standard deviation of the share
  /// of a step's way that was not driven.
  OdometryNoise(const RobotModel& model, double slip);

  /// Covariance of (x [m], y [m], yaw [rad]) at the end of a step that begins at a known pose, in
  /// the frame of that pose.
  Eigen::Matrix3d of(const Pose& step) const;

  /// Where a step leads from a pose that is not known for sure.
  PoseEstimate after(const PoseEstimate& before, const Pose& step) const;

 private:
  // Few robots' noise has been measured, and a drive has many slips.
  static constexpr double kLeastDistance = 0.03;
  static constexpr double kLeastYaw = 0.06;

  double distance_ = kLeastDistance;  // [m/sqrt(m)]
  double yaw_ = kLeastYaw;            // [rad/sqrt(rad)]
  double slip_ = 0.05;
};

}  // namespace mocha
