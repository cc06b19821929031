#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/wheel_travel.h"
#include "trajectory/arc.h"
#include "trajectory/unicycle.h"

namespace mocha {

/// The pose of a differential drive by what its wheels have rolled, from WheelTravel of both sides,
/// and how far to trust it.
///
/// Its covariance is a random walk: the variance along the path grows with the distance, that of
/// the heading with the angle turned, as wheels slip where they turn. On top comes what the
/// odometers leave open at any time.
class WheelOdometry {
 public:
  struct Options {
    double track_m = 0.0;          ///< between the wheels, as they act on the ground
    double max_wheel_speed = 0.0;  ///< [m/s]
    double noise_distance = 0.0;   ///< [m/sqrt(m)] standard deviation along the path
    double noise_yaw = 0.0;        ///< [rad/sqrt(rad)] standard deviation of the heading
  };

  explicit WheelOdometry(const Options& options);

  /// What was read at `stamp_s`: rim speeds [m/s] and odometers [cm] of both sides. The pose begins
  /// at the origin with the first reading.
  void add(double stamp_s, const WheelSpeeds& speeds, std::int64_t left_cm, std::int64_t right_cm);

  const Pose& pose() const { return pose_; }
  /// Of x, y, yaw in the frame of the pose.
  Eigen::Matrix3d covariance() const;
  /// How often the odometers began again.
  int restarts() const { return left_.restarts() + right_.restarts(); }

 private:
  void widen(const Arc& arc);

  Options options_;
  WheelTravel left_;
  WheelTravel right_;
  std::optional<double> stamp_s_;
  Pose pose_;
  Eigen::Matrix3d walk_ = Eigen::Matrix3d::Zero();
};

}  // namespace mocha
