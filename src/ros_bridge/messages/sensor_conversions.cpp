#include "ros_bridge/messages/sensor_conversions.h"

#include <cstring>

namespace mocha {
namespace {

/// Null where there is none.
const sensor_msgs::PointField* find_field(const sensor_msgs::PointCloud2& cloud, const char* name) {
  for (const auto& field : cloud.fields) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

}  // namespace

PlanarScan from_message(const sensor_msgs::LaserScan& message) {
  PlanarScan scan;
  scan.start_time_s = message.header.stamp.toSec();
  scan.time_increment_s = message.time_increment;
  scan.angle_min_rad = message.angle_min;
  scan.angle_max_rad = message.angle_max;
  scan.angle_increment_rad = message.angle_increment;
  scan.range_min_m = message.range_min;
  scan.range_max_m = message.range_max;
  scan.ranges_m = message.ranges;
  return scan;
}

std::string fault_of(const sensor_msgs::PointCloud2& cloud) {
  if (cloud.is_bigendian) return "a big-endian cloud";
  if (cloud.width == 0 || cloud.height == 0) return "a cloud without points";
  for (const char* axis : {"x", "y", "z"}) {
    const auto* field = find_field(cloud, axis);
    if (field == nullptr || field->datatype != sensor_msgs::PointField::FLOAT32 ||
        field->count != 1) {
      return "a cloud without x, y and z as float32";
    }
    if (std::uint64_t{field->offset} + sizeof(float) > cloud.point_step) {
      return "a cloud whose sizes do not match";
    }
  }
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  const bool rows_fit = row <= cloud.row_step || cloud.height == 1;
  const std::uint64_t needed = std::uint64_t{cloud.height - 1} * cloud.row_step + row;
  if (!rows_fit || cloud.data.size() < needed) return "a cloud whose sizes do not match";
  return {};
}

std::vector<Eigen::Vector3f> from_message(const sensor_msgs::PointCloud2& cloud) {
  const std::size_t offsets[] = {find_field(cloud, "x")->offset, find_field(cloud, "y")->offset,
                                 find_field(cloud, "z")->offset};
  std::vector<Eigen::Vector3f> points;
  points.reserve(static_cast<std::size_t>(cloud.width) * cloud.height);
  for (std::size_t row = 0; row < cloud.height; ++row) {
    for (std::size_t column = 0; column < cloud.width; ++column) {
      const std::uint8_t* point = &cloud.data[row * cloud.row_step + column * cloud.point_step];
      Eigen::Vector3f p;
      for (int axis = 0; axis < 3; ++axis)
        std::memcpy(&p[axis], point + offsets[axis], sizeof(float));
      points.push_back(p);
    }
  }
  return points;
}

Eigen::Isometry3d from_message(const geometry_msgs::Transform& transform) {
  const auto& t = transform.translation;
  const auto& q = transform.rotation;
  return Eigen::Translation3d(t.x, t.y, t.z) * Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

Pose planar_pose(const geometry_msgs::Transform& transform) {
  const Eigen::Isometry3d pose = from_message(transform);
  const Vector2 ahead = pose.linear().col(0).head<2>();
  return {pose.translation().head<2>(), std::atan2(ahead.y(), ahead.x())};
}

}  // namespace mocha
