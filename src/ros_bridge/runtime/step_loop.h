#pragma once

#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include <functional>
#include <string>

namespace mocha {

/// Calls a function at a fixed rate of ROS time, from the node's callback queue.
///
/// On a robot this is a timer. In simulation (`use_sim_time`) it follows /clock itself and then
/// acknowledges the step to the simulator, which waits for it: work that takes long on a slow
/// machine takes no simulated time, and nothing depends on how fast the machine is.
class StepLoop {
 public:
  /// `step(now)` is called every `period_s`. `robot` and the node's name identify the
  /// acknowledgements.
  StepLoop(ros::NodeHandle& node, const std::string& robot, double period_s,
           std::function<void(ros::Time)> step);

  /// In simulation, steps are not acknowledged from now on until they are released: something that
  /// they began is under way beside the callbacks.
  void hold() { held_ = true; }
  void release();

  /// The time: in simulation that of the newest step, which ros::Time::now() may not have heard of.
  ros::Time now() const { return ros::Time::isSimTime() ? last_ : ros::Time::now(); }

 private:
  void on_clock(const rosgraph_msgs::Clock& clock);
  void acknowledge();

  std::string robot_;
  std::string node_name_;
  ros::Duration period_;
  std::function<void(ros::Time)> step_;
  ros::Time next_;
  ros::Time last_;
  bool held_ = false;
  ros::SteadyTimer timer_;
  ros::Subscriber clock_;
  ros::Publisher acks_;
};

}  // namespace mocha
