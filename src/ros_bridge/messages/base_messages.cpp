#include "ros_bridge/messages/base_messages.h"

#include <limits>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/covariances.h"

namespace mocha {
namespace {

template <typename Vector>
void put(const Eigen::Vector3d& from, Vector& to) {
  to.x = from.x();
  to.y = from.y();
  to.z = from.z();
}

}  // namespace

nav_msgs::Odometry odometry_message(const BaseFeedback& feedback, const RobotIdentity& robot) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(feedback.stamp_s);
  message.header.frame_id = robot.odom_frame;
  message.child_frame_id = robot.base_frame;
  message.pose.pose = to_message(feedback.pose);
  put_covariance(feedback.pose_covariance, message.pose.covariance);
  message.twist.twist.linear.x = feedback.twist.speed;
  message.twist.twist.angular.z = feedback.twist.yaw_rate;
  // Across, a wheel rolls as little as it slips.
  const Eigen::Vector3d variance(feedback.speed_variance, feedback.speed_variance,
                                 feedback.yaw_rate_variance);
  put_covariance(variance.asDiagonal(), message.twist.covariance);
  return message;
}

geometry_msgs::TransformStamped odometry_transform(const BaseFeedback& feedback,
                                                   const RobotIdentity& robot) {
  return transform_message(ros::Time(feedback.stamp_s), robot.odom_frame, robot.base_frame,
                           feedback.pose);
}

sensor_msgs::Imu imu_message(const BaseFeedback& feedback, const RobotIdentity& robot) {
  sensor_msgs::Imu message;
  message.header.stamp = ros::Time(feedback.stamp_s);
  message.header.frame_id = robot.base_frame;
  message.orientation_covariance[0] = -1.0;  // none is given; all zeros: variance unknown
  put(feedback.imu->rate, message.angular_velocity);
  put(feedback.imu->acceleration, message.linear_acceleration);
  return message;
}

sensor_msgs::BatteryState battery_message(const BaseFeedback& feedback) {
  constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();
  using sensor_msgs::BatteryState;
  BatteryState message;
  message.header.stamp = ros::Time(feedback.stamp_s);
  message.voltage = static_cast<float>(*feedback.battery_v);
  message.current = message.charge = message.capacity = message.design_capacity =
      message.percentage = kNotMeasured;
  message.power_supply_status = BatteryState::POWER_SUPPLY_STATUS_UNKNOWN;
  message.power_supply_health = BatteryState::POWER_SUPPLY_HEALTH_UNKNOWN;
  message.power_supply_technology = BatteryState::POWER_SUPPLY_TECHNOLOGY_LION;
  message.present = true;
  return message;
}

}  // namespace mocha
