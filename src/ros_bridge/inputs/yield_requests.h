#pragma once

#include <ros/ros.h>

#include <functional>

#include "ros_bridge/messages/yield_request_conversions.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

/// A global planner's ends of the requests for paths: `yield_request` goes out by way of the
/// broadcaster, `fleet/yield_requests` are those of the team-mates.
class YieldRequests {
 public:
  /// What is no request of a team-mate is refused and counted.
  YieldRequests(ros::NodeHandle& node, const RobotIdentity& identity,
                std::function<void(const YieldRequest&)> hear);

  /// Says it, and shows it in rviz.
  void send(const YieldRequest& request, ros::Time now);
  int refused() const { return refused_; }

 private:
  void on_request(const mocha_ugv::YieldRequest& message);

  const RobotIdentity identity_;
  const std::function<void(const YieldRequest&)> hear_;
  int refused_ = 0;
  ros::Publisher requests_out_;
  ros::Publisher drawings_;
  ros::Subscriber requests_in_;
};

}  // namespace mocha
