#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/gyro_turn.h"
#include "base/wheel_travel.h"
#include "trajectory/arc.h"
#include "trajectory/unicycle.h"

namespace mocha {

/// The pose of a differential drive by what its wheels have rolled, from WheelTravel of both sides,
/// and how far to trust it. Where there is a gyroscope whose bias is known, it says how far the
/// base turns.
///
/// Its covariance is a random walk: the variance along the path grows with the distance; that of
/// the heading with the angle turned, as wheels slip where they turn, or by the gyroscope with the
/// time on the way. On top comes what the odometers leave open at any time.
class WheelOdometry {
 public:
  struct Options {
    double track_m;          ///< between the wheels, as they act on the ground
    double max_wheel_speed;  ///< [m/s]
    double noise_distance;   ///< [m/sqrt(m)] standard deviation along the path
    double noise_yaw;        ///< [rad/sqrt(rad)] standard deviation of the heading, by wheels
    double noise_gyro;       ///< [rad/sqrt(s)] the same by gyroscope
  };

  explicit WheelOdometry(const Options& options);

  /// What was read at `stamp_s`.
  struct Reading {
    WheelSpeeds speeds;  ///< of the rims [m/s]
    std::int64_t left_cm;
    std::int64_t right_cm;
    std::optional<double> yaw_rate;  ///< by gyroscope [rad/s], if there is one
    bool driven = false;  ///< the wheels were told to turn: they do not count as standing
  };

  /// The pose begins at the origin with the first reading.
  void add(double stamp_s, const Reading& reading);

  const Pose& pose() const { return pose_; }
  /// Of the newest reading [rad/s]; nothing where the wheels alone tell it.
  std::optional<double> gyro_yaw_rate() const { return gyro_yaw_rate_; }
  /// What the wheels did last.
  const WheelTravel& left() const { return left_; }
  const WheelTravel& right() const { return right_; }
  /// Of x, y, yaw in the frame of the pose.
  Eigen::Matrix3d covariance() const;
  /// How often the odometers began again.
  int restarts() const { return left_.restarts() + right_.restarts(); }

 private:
  bool wheels_stand(const Reading& reading) const;
  void widen(const Arc& arc, double yaw_variance);

  Options options_;
  WheelTravel left_;
  WheelTravel right_;
  GyroTurn gyro_;
  std::optional<double> gyro_yaw_rate_;
  std::optional<double> stamp_s_;
  std::int64_t left_cm_ = 0;
  std::int64_t right_cm_ = 0;
  Pose pose_;
  Eigen::Matrix3d walk_ = Eigen::Matrix3d::Zero();
};

}  // namespace mocha
