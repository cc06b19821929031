#include "ros_bridge/inputs/replanner_listener.h"

#include <ros/console.h>

#include <exception>
#include <utility>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/status_conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {

ReplannerListener::ReplannerListener(ros::NodeHandle& node, Handlers handlers)
    : handlers_(std::move(handlers)),
      followed_(
          node.subscribe("local_trajectory", 2, &ReplannerListener::on_followed, this, at_once())),
      requests_(
          node.subscribe("replan_request", 10, &ReplannerListener::on_request, this, at_once())),
      statuses_(
          node.subscribe("replanner_status", 10, &ReplannerListener::on_status, this, at_once())) {}

void ReplannerListener::on_followed(const mocha_ugv::Trajectory& message) {
  try {
    handlers_.follow(from_message(message));
  } catch (const std::exception& error) {
    refuse("local_trajectory", error.what());
  }
}

void ReplannerListener::on_request(const mocha_ugv::PlannerStatus& status) {
  handlers_.request();
  last_request_ = status.message;
}

void ReplannerListener::on_status(const mocha_ugv::ReplannerStatus& message) {
  try {
    handlers_.hear(from_message(message.status));
  } catch (const std::exception& error) {
    refuse("replanner_status", error.what());
  }
}

void ReplannerListener::refuse(const char* topic, const std::string& why) {
  ++refused_;
  ROS_WARN_THROTTLE(1.0, "Refused a message on %s: %s", topic, why.c_str());
}

}  // namespace mocha
