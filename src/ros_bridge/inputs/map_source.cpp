#include "ros_bridge/inputs/map_source.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
MapInput::MapInput(std::string frame) : frame_(std::move(frame)) {}

void MapInput::on_map(const nav_msgs::OccupancyGrid& map) {
  try {
    if (map.header.frame_id != frame_) {
      throw std::invalid_argument("is in frame `" + map.header.frame_id + "`, not in `" + frame_ +
                                  "`");
    }
    take(from_message(map));
    stamp_ = map.header.stamp;
  } catch (const std::exception& error) {
    ++refused_;
    ROS_WARN_THROTTLE(5.0, "Refused a map: it %s", error.what());
  }
}

double MapInput::age_s(ros::Time now) const {
  return available() ? (now - stamp_).toSec() : std::numeric_limits<double>::infinity();
}

MapSource::MapSource(ros::NodeHandle& node, std::string frame)
    : MapInput(std::move(frame)),
      maps_(node.subscribe("map", 1, &MapInput::on_map, static_cast<MapInput*>(this), at_once())) {}

}  // namespace mocha
