#include "ros_bridge/inputs/yield_requests.h"

#include <stdexcept>
#include <utility>

#include "ros_bridge/runtime/transport.h"
#include "ros_bridge/rviz/markers.h"

namespace mocha {
namespace {

constexpr double kBreadth_m = 0.12;
constexpr double kTextHeight_m = 0.25;
const std_msgs::ColorRGBA kColor = color(0.9, 0.45, 0.0, 0.7);

}  // namespace

YieldRequests::YieldRequests(ros::NodeHandle& node, const RobotIdentity& identity,
                             std::function<void(const YieldRequest&)> hear)
    : identity_(identity),
      hear_(std::move(hear)),
      requests_out_(node.advertise<mocha_ugv::YieldRequest>("yield_request", 10)),
      drawings_(node.advertise<visualization_msgs::MarkerArray>("yield_markers", 2, true)),
      requests_in_(node.subscribe("fleet/yield_requests", 100, &YieldRequests::on_request, this,
                                  at_once())) {}

void YieldRequests::send(const YieldRequest& request, ros::Time now) {
  requests_out_.publish(to_message(request, identity_.map_frame, now));
  Drawing drawing(identity_.map_frame, now);
  if (request.path.size() > 1) {
    drawing.add_line("asked for", request.path, kBreadth_m, kColor, false);
    const std::string whose =
        request.rank.agent == request.agent ? "" : " for " + request.rank.agent;
    drawing.add_label("asked for", identity_.name + " asks for its way" + whose,
                      request.path[request.path.size() / 2], kTextHeight_m, kColor);
  }
  drawings_.publish(drawing.markers());
}

void YieldRequests::on_request(const mocha_ugv::YieldRequest& message) {
  try {
    hear_(yield_request_from_message(message, identity_.map_frame));
  } catch (const std::invalid_argument& error) {
    ++refused_;
    ROS_WARN_THROTTLE(1.0, "Refused a message on fleet/yield_requests: %s", error.what());
  }
}

}  // namespace mocha
