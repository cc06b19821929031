#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <limits>
#include <optional>
#include <string>

#include "control/robot_state.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

/// What is known about where the robot is at one time.
struct PoseReading {
  std::optional<RobotState>
      state;     ///< in the map frame, as of its stamp; nothing where something is missing
  Pose in_odom;  ///< the same in the odometry's own frame
  double odometry_age_s = std::numeric_limits<double>::infinity();
  double transform_age_s =
      std::numeric_limits<double>::infinity();  ///< of map -> odom; 0 for a static one
  std::string missing;                          ///< what, in words; empty where there is a state
};

/// Combines the newest odometry with the newest transform map -> odom, so that the pose is as fresh
/// as the odometry.
class OdometryPose {
 public:
  /// Older input than these ages is as good as none. `topic` is for messages to people.
  OdometryPose(std::string map_frame, std::string topic, double max_odometry_age_s,
               double max_transform_age_s);

  /// Malformed odometry is refused and counted.
  void on_odometry(const nav_msgs::Odometry& odometry);

  PoseReading read(const tf2::BufferCore& transforms, double now_s) const;
  int refused() const { return refused_; }

 private:
  std::string map_frame_;
  std::string topic_;
  double max_odometry_age_s_;
  double max_transform_age_s_;
  std::string odom_frame_;  // empty before the first odometry
  RobotState in_odom_;
  int refused_ = 0;
};

/// The pose of this node's robot, from `odom` and tf. Callbacks run in the node's own queue.
class PoseSource {
 public:
  PoseSource(ros::NodeHandle& node, const RobotIdentity& robot, double max_odometry_age_s,
             double max_transform_age_s);

  PoseReading read(ros::Time now) const { return pose_.read(transforms_, now.toSec()); }
  const tf2::BufferCore& transforms() const { return transforms_; }
  int refused() const { return pose_.refused(); }

 private:
  OdometryPose pose_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  ros::Subscriber odometry_;
};

}  // namespace mocha
