#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <mocha_ugv/Localization.h>

#include <optional>
#include <string>

#include "perception/localization/scan_localizer.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

/// State, figures and words; the header's stamp is the scan's.
mocha_ugv::Localization to_message(const Localization& localization, const RobotIdentity& robot);

/// base_link in the map, with covariance.
geometry_msgs::PoseWithCovarianceStamped pose_message(const Localization& localization,
                                                      const RobotIdentity& robot);

/// map -> odom.
geometry_msgs::TransformStamped map_to_odom(const Localization& localization,
                                            const RobotIdentity& robot);

/// A place that is given to the robot, as by rviz's 2D Pose Estimate. Deviations below 0.2 m
/// and 0.1 rad are raised to these: a hand points no more exactly. Nothing where the message is not
/// in `map_frame`, or not finite, or its covariance is none; `fault` then says why.
std::optional<PoseEstimate> from_message(const geometry_msgs::PoseWithCovarianceStamped& message,
                                         const std::string& map_frame, std::string& fault);

}  // namespace mocha
