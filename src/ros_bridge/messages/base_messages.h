#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Imu.h>

#include "base/base_interface.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

/// What a base says of itself, as ROS says it. Covariances of what it cannot know are large, those
/// of what it does not measure are marked so (-1), as the messages ask for.

nav_msgs::Odometry odometry_message(const BaseFeedback& feedback, const RobotIdentity& robot);

/// odom -> base_link.
geometry_msgs::TransformStamped odometry_transform(const BaseFeedback& feedback,
                                                   const RobotIdentity& robot);

/// Only of feedback with an IMU.
sensor_msgs::Imu imu_message(const BaseFeedback& feedback, const RobotIdentity& robot);

/// Only of feedback with a battery.
sensor_msgs::BatteryState battery_message(const BaseFeedback& feedback);

}  // namespace mocha
