#include "ros/commitment_source.h"

#include <ros/console.h>

#include <exception>
#include <utility>

#include "ros/conversions.h"
#include "ros/transport.h"

namespace mocha {

CommitmentSource::CommitmentSource(ros::NodeHandle& node, std::string own_name)
    : own_name_(std::move(own_name)),
      commitments_(node.subscribe("committed_trajectory", 10, &CommitmentSource::on_committed, this,
                                  at_once())) {}

void CommitmentSource::on_committed(const mocha_ugv::Trajectory& message) {
  try {
    motion_ = from_message(message);
  } catch (const std::exception& error) {
    ++refused_;
    ROS_WARN_THROTTLE(1.0, "%s: refused a message on committed_trajectory: %s", own_name_.c_str(),
                      error.what());
  }
}

}  // namespace mocha
