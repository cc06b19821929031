#include "base/wheel_odometry.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kOdometerVariance_m2 = 0.01 * 0.01 / 12.0;  // anywhere in a centimetre

}  // namespace

WheelOdometry::WheelOdometry(const Options& options)
    : options_(options), left_(options.max_wheel_speed), right_(options.max_wheel_speed) {}

void WheelOdometry::add(double stamp_s, const Reading& reading) {
  const double dt_s = std::max(0.0, stamp_s - stamp_s_.value_or(stamp_s));
  stamp_s_ = stamp_s;
  const WheelSpeeds rolled{left_.add(dt_s, reading.speeds.left, reading.left_cm),
                           right_.add(dt_s, reading.speeds.right, reading.right_cm)};
  const UnicycleState driven = from_wheel_speeds(rolled, options_.track_m);  // per step
  Arc arc{driven.speed, driven.yaw_rate};
  double yaw_variance = options_.noise_yaw * options_.noise_yaw * std::abs(arc.turn_rad);
  gyro_yaw_rate_.reset();
  if (reading.yaw_rate) {
    const auto turned = gyro_.add(dt_s, *reading.yaw_rate, wheels_stand(reading));
    gyro_yaw_rate_ = gyro_.unbiased(*reading.yaw_rate);
    if (turned) {
      arc.turn_rad = *turned;
      yaw_variance = *turned == 0.0 ? 0.0 : options_.noise_gyro * options_.noise_gyro * dt_s;
    }
  }
  left_cm_ = reading.left_cm;
  right_cm_ = reading.right_cm;
  widen(arc, yaw_variance);
  pose_ = advanced(pose_, arc);
}

bool WheelOdometry::wheels_stand(const Reading& reading) const {
  return !reading.driven && reading.speeds.left == 0.0 && reading.speeds.right == 0.0 &&
         reading.left_cm == left_cm_ && reading.right_cm == right_cm_;
}

void WheelOdometry::widen(const Arc& arc, double yaw_variance) {
  const double towards = pose_.yaw_rad + 0.5 * arc.turn_rad;
  const Eigen::Vector3d along(std::cos(towards), std::sin(towards), 0.0);
  Eigen::Matrix3d carried = Eigen::Matrix3d::Identity();
  carried(0, 2) = -arc.length_m * along.y();
  carried(1, 2) = arc.length_m * along.x();
  const double along_variance =
      options_.noise_distance * options_.noise_distance * std::abs(arc.length_m);
  walk_ = carried * walk_ * carried.transpose() + along_variance * along * along.transpose();
  walk_(2, 2) += yaw_variance;
}

Eigen::Matrix3d WheelOdometry::covariance() const {
  // Both sides at both times; the position is their mean, the heading their difference.
  const double position = 0.5 * 2.0 * kOdometerVariance_m2;
  const double yaw = 2.0 * 2.0 * kOdometerVariance_m2 / (options_.track_m * options_.track_m);
  return walk_ + Eigen::Vector3d(position, position, yaw).asDiagonal().toDenseMatrix();
}

}  // namespace mocha
