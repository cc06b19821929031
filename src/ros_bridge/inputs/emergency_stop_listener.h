#pragma once

#include <mocha_ugv/EmergencyStopState.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>

#include <functional>
#include <string>

#include "control/stop_latch.h"

namespace mocha {

/// A node's ear for emergency stops: `emergency_stop` and `fleet/emergency_stop`, where true stops
/// at once, whatever else is alive, and `emergency_stop_state`, which alone says of a reset.
class EmergencyStopListener {
 public:
  /// `stopped` is called with each new stop.
  explicit EmergencyStopListener(
      ros::NodeHandle& node, std::function<void()> stopped = [] {});

  bool stopped() const { return latch_.stopped(); }
  /// `emergency_stop_state` has said that no stop holds.
  bool released() const { return latch_.released(); }
  /// How often it came to be stopped.
  int stops() const { return stops_; }
  /// Which stops hold and how to reset them; empty while none does.
  std::string reason() const;

 private:
  void on_stop(const ros::MessageEvent<const std_msgs::Bool>& event);
  void on_state(const mocha_ugv::EmergencyStopState& state);

  void count_if(bool is_new);

  const std::function<void()> on_new_stop_;
  StopLatch latch_;
  int stops_ = 0;
  std::string message_;  // of the state
  std::string sender_;   // of the newest "stop"
  ros::Subscriber robot_;
  ros::Subscriber fleet_;
  ros::Subscriber states_;
};

}  // namespace mocha
