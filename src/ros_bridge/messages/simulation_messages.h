#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <mocha_ugv/Contact.h>
#include <mocha_ugv/GroundTruth.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>

#include "simulation/world_simulator.h"

namespace mocha {

/// What the simulator publishes about its robots. Frames: map, <robot>/odom, <robot>/base_link,
/// <robot>/laser.

/// The drifting pose, and the twist that the wheels measure.
nav_msgs::Odometry odometry_message(const SimulatedRobot& robot, ros::Time stamp);

sensor_msgs::LaserScan scan_message(const SimulatedRobot& robot, const Scan& scan);

geometry_msgs::TransformStamped odom_to_base(const SimulatedRobot& robot, ros::Time stamp);
/// From the truth: what a perfect localiser would say.
geometry_msgs::TransformStamped map_to_odom(const SimulatedRobot& robot, ros::Time stamp);
/// The same where odometry comes from elsewhere, and was right at its stamp.
geometry_msgs::TransformStamped map_to_odom(const SimulatedRobot& robot,
                                            const nav_msgs::Odometry& odometry, ros::Time stamp);
geometry_msgs::TransformStamped base_to_laser(const SimulatedRobot& robot);

mocha_ugv::GroundTruth ground_truth_message(const WorldSimulator& simulator, ros::Time stamp);
mocha_ugv::Contact contact_message(const ContactEvent& contact, ros::Time stamp);

}  // namespace mocha
