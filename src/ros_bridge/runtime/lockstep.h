#pragma once

#include <mocha_ugv/StepAck.h>
#include <ros/ros.h>

#include <functional>

#include "simulation/ack_roster.h"

namespace mocha {

/// The simulator's clock: publishes /clock and waits until all nodes in the roster have
/// acknowledged the step. While it waits it serves the global callback queue, so that all of this
/// happens in one thread.
class Lockstep {
 public:
  Lockstep(ros::NodeHandle& node, AckRoster roster, ros::WallDuration start_timeout,
           ros::WallDuration ack_timeout);

  /// Shows `start` again and again until all expected nodes are there or the start timeout has
  /// passed.
  void await_nodes(ros::Time start);

  /// Shows `now` and waits for the acknowledgements; a node without one within the ack timeout
  /// is reported and left out.
  void announce(ros::Time now);

  std::vector<std::string> missing() const { return roster_.missing(); }

 private:
  void on_ack(const mocha_ugv::StepAck& ack);
  void show(ros::Time now);
  bool serve_until_acknowledged(ros::Time stamp, ros::WallTime deadline);

  AckRoster roster_;
  ros::WallDuration start_timeout_;
  ros::WallDuration ack_timeout_;
  ros::Publisher clock_;
  ros::Subscriber acks_;
};

/// Handles callbacks until `done()` or the deadline, asleep while there are none. Returns done().
bool serve_until(ros::WallTime deadline, const std::function<bool()>& done);

}  // namespace mocha
