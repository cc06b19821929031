#include "ros_bridge/messages/map_conversions.h"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ros_bridge/messages/conversions.h"

namespace mocha {
namespace {

constexpr std::size_t kMostCells = 100'000'000;

std::vector<std::int8_t> cells_of(const std::vector<std::int8_t>& values) {
  std::vector<std::int8_t> cells(values.size());
  std::transform(values.begin(), values.end(), cells.begin(), cell_of_probability);
  return cells;
}

}  // namespace

void to_message(const OccupancyGrid& grid, nav_msgs::OccupancyGrid& message) {
  message.info.resolution = static_cast<float>(grid.resolution_m);
  message.info.width = static_cast<std::uint32_t>(grid.width);
  message.info.height = static_cast<std::uint32_t>(grid.height);
  message.info.origin.position.x = grid.origin.x();
  message.info.origin.position.y = grid.origin.y();
  message.info.origin.orientation.w = 1.0;
  message.data = grid.cells;
}

OccupancyGrid from_message(const nav_msgs::OccupancyGrid& map) {
  const Pose origin = from_message(map.info.origin);
  const std::size_t cells = static_cast<std::size_t>(map.info.width) * map.info.height;
  if (cells == 0 || cells > kMostCells || map.data.size() != cells) {
    throw std::invalid_argument("has sizes that do not match");
  }
  if (!(map.info.resolution > 1e-4f) || !std::isfinite(map.info.resolution) ||
      !origin.position.allFinite()) {
    throw std::invalid_argument("has no finite resolution or origin");
  }
  if (!(std::abs(origin.yaw_rad) < 1e-6)) throw std::invalid_argument("has a rotated origin");
  OccupancyGrid grid;
  grid.resolution_m = map.info.resolution;
  grid.origin = origin.position;
  grid.width = static_cast<int>(map.info.width);
  grid.height = static_cast<int>(map.info.height);
  grid.cells = cells_of(map.data);
  return grid;
}

void to_message(const GridUpdate& update, map_msgs::OccupancyGridUpdate& message) {
  message.x = update.x;
  message.y = update.y;
  message.width = static_cast<std::uint32_t>(update.width);
  message.height = static_cast<std::uint32_t>(update.height);
  message.data = update.cells;
}

GridUpdate from_message(const map_msgs::OccupancyGridUpdate& update) {
  const std::size_t cells = static_cast<std::size_t>(update.width) * update.height;
  if (update.width > kMostCells || update.height > kMostCells || update.data.size() != cells)
    throw std::invalid_argument("has sizes that do not match");
  return {update.x, update.y, static_cast<int>(update.width), static_cast<int>(update.height),
          cells_of(update.data)};
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
