#pragma once

#include <geometry_msgs/Transform.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "perception/sensor/planar_scan.h"
#include "trajectory/motion.h"

namespace mocha {

/// The scan as it is; whether it makes sense is for fault_of() to say.
PlanarScan from_message(const sensor_msgs::LaserScan& scan);

/// What keeps a cloud from being read, in a few words; empty for a cloud with x, y, z (float32) and
/// sizes that match.
std::string fault_of(const sensor_msgs::PointCloud2& cloud);

/// The points of a cloud without fault.
std::vector<Eigen::Vector3f> from_message(const sensor_msgs::PointCloud2& cloud);

Eigen::Isometry3d from_message(const geometry_msgs::Transform& transform);

/// What of the transform happens in the plane.
Pose planar_pose(const geometry_msgs::Transform& transform);

}  // namespace mocha
