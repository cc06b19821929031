#include "perception/localization/odometry_noise.h"

#include <algorithm>
#include <cmath>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kTurnPerMetre = 0.1;  // a metre bends the heading as such a turn does [rad/m]

}  // namespace

OdometryNoise::OdometryNoise(const RobotModel& model, double slip)
    : distance_(std::max(kLeastDistance, 2.0 * model.odometry_noise_distance)),
      yaw_(std::max(kLeastYaw, 2.0 * model.odometry_noise_yaw)),
      slip_(slip) {}

Eigen::Matrix3d OdometryNoise::of(const Pose& step) const {
  const double driven_m = step.position.norm();
  const double turn_rad2 = yaw_ * yaw_ * (std::abs(step.yaw_rad) + kTurnPerMetre * driven_m);
  const double along_m2 = distance_ * distance_ * driven_m + std::pow(slip_ * driven_m, 2);
  // What bends on the way leads aside.
  const double aside_m2 = distance_ * distance_ * driven_m + turn_rad2 * driven_m * driven_m / 3.0;
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  noise.topLeftCorner<2, 2>() = aside_m2 * Eigen::Matrix2d::Identity();
  if (driven_m > 0.0) {
    const Vector2 ahead = step.position / driven_m;
    noise.topLeftCorner<2, 2>() += (along_m2 - aside_m2) * ahead * ahead.transpose();
  }
  noise(2, 2) = turn_rad2;
  return noise;
}

PoseEstimate OdometryNoise::after(const PoseEstimate& before, const Pose& step) const {
  PoseEstimate result{composed(before.pose, step), before.covariance};
  const Vector2 way = result.pose.position - before.pose.position;
  Eigen::Matrix3d carried = Eigen::Matrix3d::Identity();
  carried(0, 2) = -way.y();
  carried(1, 2) = way.x();
  Eigen::Matrix3d to_map = Eigen::Matrix3d::Identity();
  to_map.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(before.pose.yaw_rad).toRotationMatrix();
  result.covariance =
      carried * before.covariance * carried.transpose() + to_map * of(step) * to_map.transpose();
  return result;
}

}  // namespace mocha
