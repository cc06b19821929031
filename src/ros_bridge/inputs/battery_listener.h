#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/BatteryState.h>

#include <functional>
#include <string>

#include "planning/executive/low_battery.h"

namespace mocha {

/// Hears the topic `battery`, and has the robot do what LowBattery says.
class BatteryListener {
 public:
  struct Handlers {
    std::function<void(const std::string&)> give_up;  ///< all goals, and why
    std::function<void(const Goal&)> take;
  };

  BatteryListener(ros::NodeHandle& node, const LowBattery::Options& options, Handlers handlers);

  /// See LowBattery::step().
  void step(ros::Time now, bool idle, bool stopped);
  void arrive() { battery_.arrive(); }
  void go_on() { battery_.go_on(); }

  bool low() const { return battery_.low(); }
  /// Why no goal is taken; empty where one is.
  std::string reason() const { return battery_.reason(); }

 private:
  LowBattery battery_;
  Handlers handlers_;
  ros::Subscriber voltages_;
};

}  // namespace mocha
