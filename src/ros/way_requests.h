#pragma once

#include <ros/ros.h>

#include <functional>

#include "ros/robot_identity.h"
#include "ros/way_request_conversions.h"

namespace mocha {

/// A global planner's ends of the requests for ways: `way_request` goes out by way of the
/// broadcaster, `fleet/way_requests` are those of the team-mates.
class WayRequests {
 public:
  /// What is no request of a team-mate is refused and counted.
  WayRequests(ros::NodeHandle& node, const RobotIdentity& identity,
              std::function<void(const WayRequest&)> hear);

  /// Says it, and shows it in rviz.
  void send(const WayRequest& request, ros::Time now);
  int refused() const { return refused_; }

 private:
  void on_request(const mocha_ugv::WayRequest& message);

  const RobotIdentity identity_;
  const std::function<void(const WayRequest&)> hear_;
  int refused_ = 0;
  ros::Publisher requests_out_;
  ros::Publisher drawings_;
  ros::Subscriber requests_in_;
};

}  // namespace mocha
