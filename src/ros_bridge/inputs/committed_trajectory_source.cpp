#include "ros_bridge/inputs/committed_trajectory_source.h"

#include <ros/console.h>

#include <exception>
#include <utility>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {

CommittedTrajectorySource::CommittedTrajectorySource(ros::NodeHandle& node, std::string own_name)
    : own_name_(std::move(own_name)),
      commitments_(node.subscribe("committed_trajectory", 10,
                                  &CommittedTrajectorySource::on_committed, this, at_once())) {}

void CommittedTrajectorySource::on_committed(const mocha_ugv::Trajectory& message) {
  try {
    motion_ = from_message(message);
  } catch (const std::exception& error) {
    ++refused_;
    ROS_WARN_THROTTLE(1.0, "%s: refused a message on committed_trajectory: %s", own_name_.c_str(),
                      error.what());
  }
}

}  // namespace mocha
