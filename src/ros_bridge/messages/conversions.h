#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/TransformStamped.h>
#include <mocha_ugv/Trajectory.h>

#include <string>

#include "trajectory/braking.h"
#include "trajectory/motion.h"

namespace mocha {

/// Fills start and phases of the message; the other fields stay as they are.
void to_message(const Motion& motion, mocha_ugv::Trajectory& message);

/// Rebuilds the motion. Throws std::invalid_argument for a message that does not describe a valid
/// motion.
Motion from_message(const mocha_ugv::Trajectory& message);

/// Fills how the robot brakes.
void to_message(const Braking& braking, mocha_ugv::Trajectory& message);
/// Throws std::invalid_argument for numbers that are none of a braking.
Braking braking_from_message(const mocha_ugv::Trajectory& message);

/// Zero where ROS has no such time.
ros::Time ros_time(double t);

geometry_msgs::Quaternion quaternion_of(double yaw_rad);
geometry_msgs::Pose to_message(const Pose& pose);
/// Position and heading; anything out of the plane is dropped.
Pose from_message(const geometry_msgs::Pose& pose);

/// Where `child` stands in `parent`, `height_m` above the plane.
geometry_msgs::TransformStamped transform_message(ros::Time stamp, const std::string& parent,
                                                  const std::string& child, const Pose& pose,
                                                  double height_m = 0.0);

}  // namespace mocha
