#pragma once

#include <ros/ros.h>

namespace mocha {

/// Warns while a node waits for a simulated clock that nobody publishes, as after a simulation
/// under the same roscore: nothing else would be said.
class ClockWatch {
 public:
  explicit ClockWatch(const ros::NodeHandle& node);

 private:
  void look();

  ros::WallTimer timer_;
};

}  // namespace mocha
