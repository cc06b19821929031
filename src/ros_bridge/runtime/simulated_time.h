#pragma once

#include <ros/master.h>
#include <ros/this_node.h>
#include <ros/time.h>

#include "ros_bridge/runtime/raw_call.h"

namespace mocha {

/// Where time is simulated, that ends with this: nodes that start later under the same master would
/// wait for a clock that nobody publishes any more.
class SimulatedTime {
 public:
  SimulatedTime() = default;
  SimulatedTime(const SimulatedTime&) = delete;
  SimulatedTime& operator=(const SimulatedTime&) = delete;
  ~SimulatedTime() {
    if (!is_simulated_) return;
    XmlRpc::XmlRpcValue arguments;
    arguments[0] = ros::this_node::getName();
    arguments[1] = "/use_sim_time";
    arguments[2] = false;
    raw_call(ros::master::getURI(), "setParam", arguments);
  }

 private:
  const bool is_simulated_ = ros::Time::isSimTime();
};

}  // namespace mocha
