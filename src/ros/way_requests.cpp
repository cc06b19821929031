#include "ros/way_requests.h"

#include <stdexcept>
#include <utility>

#include "ros/markers.h"
#include "ros/transport.h"

namespace mocha {
namespace {

constexpr double kBreadth_m = 0.12;
constexpr double kTextHeight_m = 0.25;
const std_msgs::ColorRGBA kColor = color(0.9, 0.45, 0.0, 0.7);

}  // namespace

WayRequests::WayRequests(ros::NodeHandle& node, const RobotIdentity& identity,
                         std::function<void(const WayRequest&)> hear)
    : identity_(identity),
      hear_(std::move(hear)),
      requests_out_(node.advertise<mocha_ugv::WayRequest>("way_request", 10)),
      drawings_(node.advertise<visualization_msgs::MarkerArray>("way_markers", 2, true)),
      requests_in_(
          node.subscribe("fleet/way_requests", 100, &WayRequests::on_request, this, at_once())) {}

void WayRequests::send(const WayRequest& request, ros::Time now) {
  requests_out_.publish(to_message(request, identity_.map_frame, now));
  Drawing drawing(identity_.map_frame, now);
  if (request.way.size() > 1) {
    drawing.add_line("asked for", request.way, kBreadth_m, kColor, false);
    const std::string whose =
        request.rank.agent == request.agent ? "" : " for " + request.rank.agent;
    drawing.add_label("asked for", identity_.name + " asks for its way" + whose,
                      request.way[request.way.size() / 2], kTextHeight_m, kColor);
  }
  drawings_.publish(drawing.markers());
}

void WayRequests::on_request(const mocha_ugv::WayRequest& message) {
  try {
    hear_(way_request_from_message(message, identity_.map_frame));
  } catch (const std::invalid_argument& error) {
    ++refused_;
    ROS_WARN_THROTTLE(1.0, "Refused a message on fleet/way_requests: %s", error.what());
  }
}

}  // namespace mocha
