#include "ros_bridge/messages/yield_request_conversions.h"

#include <stdexcept>

namespace mocha {

mocha_ugv::YieldRequest to_message(const YieldRequest& request, const std::string& frame,
                                   ros::Time stamp) {
  mocha_ugv::YieldRequest message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.agent = request.agent;
  message.epoch = request.epoch;
  message.stuck = request.rank.stuck;
  message.priority = request.rank.priority;
  message.behalf = request.rank.agent;
  message.radius = request.radius_m;
  message.speed = request.speed_mps;
  for (const Vector2& place : request.path) {
    geometry_msgs::Point point;
    point.x = place.x();
    point.y = place.y();
    message.path.push_back(point);
  }
  return message;
}

YieldRequest yield_request_from_message(const mocha_ugv::YieldRequest& message,
                                        const std::string& frame) {
  if (message.header.frame_id != frame) {
    throw std::invalid_argument("is in frame '" + message.header.frame_id + "', not in '" + frame +
                                "'");
  }
  YieldRequest request;
  request.agent = message.agent;
  request.epoch = message.epoch;
  request.rank = {message.stuck != 0, message.priority, message.behalf};
  request.radius_m = message.radius;
  request.speed_mps = message.speed;
  for (const auto& point : message.path) request.path.emplace_back(point.x, point.y);
  validate(request);
  return request;
}

}  // namespace mocha
