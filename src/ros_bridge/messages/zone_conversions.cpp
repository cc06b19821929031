#include "ros_bridge/messages/zone_conversions.h"

namespace mocha {

void to_message(const Zones& zones, mocha_ugv::Zones& message) {
  message.zones.clear();
  for (const Zone& zone : zones) {
    mocha_ugv::Zone& entry = message.zones.emplace_back();
    entry.name = zone.name;
    entry.max_speed = zone.max_speed;
    for (const Vector2& corner : zone.area.corners) {
      entry.area.points.emplace_back();
      entry.area.points.back().x = static_cast<float>(corner.x());
      entry.area.points.back().y = static_cast<float>(corner.y());
    }
  }
}

Zones from_message(const std::vector<mocha_ugv::Zone>& zones) {
  Zones read;
  for (const mocha_ugv::Zone& entry : zones) {
    Zone& zone = read.emplace_back();
    zone.name = entry.name.empty() ? "zones[" + std::to_string(read.size() - 1) + "]" : entry.name;
    zone.max_speed = entry.max_speed;
    auto& corners = zone.area.corners;
    for (const auto& point : entry.area.points) corners.emplace_back(point.x, point.y);
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  }
  check(read);
  return read;
}

}  // namespace mocha
