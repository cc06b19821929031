#include "ros_bridge/inputs/zone_source.h"

#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/zone_conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {

ZoneSource::ZoneSource(ros::NodeHandle& node, std::string frame, Changed changed)
    : frame_(std::move(frame)),
      changed_(std::move(changed)),
      messages_(node.subscribe("zones", 2, &ZoneSource::on_zones, this, at_once())) {}

std::string ZoneSource::refusal(const std::deque<Goal>& goals) const {
  for (const Goal& goal : goals) {
    if (const Zone* zone = keep_out_zone_at(zones_, goal.position)) {
      std::ostringstream text;
      text << std::fixed << std::setprecision(2) << "(" << goal.position.x() << ", "
           << goal.position.y() << ") lies in keep-out zone `" << zone->name << "`";
      return text.str();
    }
  }
  return "";
}

void ZoneSource::on_zones(const mocha_ugv::Zones& message) {
  try {
    if (message.header.frame_id != frame_)
      throw std::invalid_argument("frame `" + message.header.frame_id + "`, not `" + frame_ + "`");
    zones_ = from_message(message.zones);
  } catch (const std::invalid_argument& error) {
    ++refused_;
    ROS_WARN_THROTTLE(1.0, "Refused a message on zones: %s", error.what());
    return;
  }
  exit_.clear();
  for (const auto& point : message.exit) exit_.emplace_back(point.x, point.y);
  const bool were_known = std::exchange(are_known_, true);
  const ros::Time before = std::exchange(since_, message.header.stamp);
  const bool is_news = since_ != before || !were_known;
  if (is_news) changed_(were_known);
}

}  // namespace mocha
