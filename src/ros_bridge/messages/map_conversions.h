#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Core>
#include <vector>

#include "world/occupancy_grid.h"

namespace mocha {

/// Info and data of the message (0 free, 100 occupied, -1 unknown); the header stays as it is.
void to_message(const OccupancyGrid& grid, nav_msgs::OccupancyGrid& message);

/// Points with the fields x, y, z; the header stays as it is.
void to_message(const std::vector<Eigen::Vector3f>& points, sensor_msgs::PointCloud2& message);

}  // namespace mocha
