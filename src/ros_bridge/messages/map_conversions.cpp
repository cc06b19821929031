#include "ros_bridge/messages/map_conversions.h"

#include <sensor_msgs/point_cloud2_iterator.h>

namespace mocha {

void to_message(const OccupancyGrid& grid, nav_msgs::OccupancyGrid& message) {
  message.info.resolution = static_cast<float>(grid.resolution_m);
  message.info.width = static_cast<std::uint32_t>(grid.width);
  message.info.height = static_cast<std::uint32_t>(grid.height);
  message.info.origin.position.x = grid.origin.x();
  message.info.origin.position.y = grid.origin.y();
  message.info.origin.orientation.w = 1.0;
  message.data = grid.cells;
}

void to_message(const std::vector<Eigen::Vector3f>& points, sensor_msgs::PointCloud2& message) {
  sensor_msgs::PointCloud2Modifier modifier(message);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> x(message, "x");
  for (const Eigen::Vector3f& point : points) {
    x[0] = point.x();
    x[1] = point.y();
    x[2] = point.z();
    ++x;
  }
}

}  // namespace mocha
