#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Core>
#include <vector>

#include "world/occupancy_grid.h"

namespace mocha {

/// Info and data of the message (0 free, 100 occupied, -1 unknown); the header stays as it is.
void to_message(const OccupancyGrid& grid, nav_msgs::OccupancyGrid& message);

/// Cells from 65 on count as occupied, from 0 to 25 as free, all else as unknown. Throws
/// std::invalid_argument for sizes that do not match, a rotated origin, or values that are not
/// finite.
OccupancyGrid from_message(const nav_msgs::OccupancyGrid& map);

/// All but the header, which stays as it is.
void to_message(const GridUpdate& update, map_msgs::OccupancyGridUpdate& message);

/// Cells as those of whole grids. Throws std::invalid_argument for sizes that do not match.
GridUpdate from_message(const map_msgs::OccupancyGridUpdate& update);

/// Points with the fields x, y, z; the header stays as it is.
void to_message(const std::vector<Eigen::Vector3f>& points, sensor_msgs::PointCloud2& message);

}  // namespace mocha
