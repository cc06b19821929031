#include "ros_bridge/messages/pose_graph_messages.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace mocha {
namespace {

geometry_msgs::Point32 to_point(const Vector2& place) {
  geometry_msgs::Point32 point;
  point.x = static_cast<float>(place.x());
  point.y = static_cast<float>(place.y());
  return point;
}

Vector2 from_point(const geometry_msgs::Point32& point) { return {point.x, point.y}; }

}  // namespace

mocha_ugv::MapKeyframe to_message(const ScanHits& scan) {
  mocha_ugv::MapKeyframe message;
  message.sensor = to_point(scan.sensor);
  std::transform(scan.hits.begin(), scan.hits.end(), std::back_inserter(message.hits), to_point);
  std::transform(scan.misses.begin(), scan.misses.end(), std::back_inserter(message.misses),
                 to_point);
  return message;
}

ScanHits from_message(const mocha_ugv::MapKeyframe& message) {
  ScanHits scan;
  scan.sensor = from_point(message.sensor);
  std::transform(message.hits.begin(), message.hits.end(), std::back_inserter(scan.hits),
                 from_point);
  std::transform(message.misses.begin(), message.misses.end(), std::back_inserter(scan.misses),
                 from_point);
  check_measured(scan, {});
  return scan;
}

void to_message(const std::vector<Pose>& poses, mocha_ugv::PoseGraph& message) {
  message.keyframes.clear();
  for (const Pose& pose : poses) {
    geometry_msgs::Pose2D& keyframe = message.keyframes.emplace_back();
    keyframe.x = pose.position.x();
    keyframe.y = pose.position.y();
    keyframe.theta = pose.yaw_rad;
  }
}

std::vector<Pose> poses_of(const mocha_ugv::PoseGraph& message) {
  std::vector<Pose> poses;
  for (const geometry_msgs::Pose2D& keyframe : message.keyframes) {
    const Pose pose{{keyframe.x, keyframe.y}, keyframe.theta};
    if (!is_usable(pose.position) || !std::isfinite(pose.yaw_rad))
      throw std::invalid_argument("a keyframe is nowhere, or too far away");
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace mocha
