#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <mocha_ugv/FleetStops.h>
#include <mocha_ugv/Heartbeat.h>
#include <mocha_ugv/PassingInstruction.h>
#include <mocha_ugv/PassingIntent.h>
#include <mocha_ugv/Trajectory.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "fleet/wire/datagram_link.h"
#include "ros_bridge/network/lcm_channel.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

struct FleetNetworkOptions {
  std::string lcm_url;    ///< empty: the shared topics
  std::string fleet_key;  ///< path of a key file; empty: none
};

/// How the robots of a fleet hear each other: datagrams over LCM, or where they share a roscore,
/// the topics /fleet/promises, /fleet/heartbeats, /fleet/passing_intents,
/// /fleet/passing_instructions and /fleet/emergency_stops. What comes from outside and is no use is
/// counted and reported.
class FleetNetwork {
 public:
  /// `hear` gets what others say, in the node's thread. Throws std::runtime_error for a url that
  /// LCM cannot use and for a key file that holds no key.
  FleetNetwork(ros::NodeHandle& node, const RobotIdentity& robot,
               const FleetNetworkOptions& options, std::function<void(const FleetMessage&)> hear);

  void send(const FleetMessage& message, ros::Time now);

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  /// Share of a peer's newest datagrams that did not come; none where they are not counted.
  std::optional<double> loss(const std::string& peer) const;
  int refused() const { return refused_ + link_.counts().refused(); }

 private:
  template <typename Message>
  using Event = ros::MessageEvent<const Message>;

  void on_trajectory(const Event<mocha_ugv::Trajectory>& event);
  void on_heartbeat(const Event<mocha_ugv::Heartbeat>& event);
  void on_intent(const Event<mocha_ugv::PassingIntent>& event);
  void on_instruction(const Event<mocha_ugv::PassingInstruction>& event);
  void on_stops(const Event<mocha_ugv::FleetStops>& event);
  void on_datagram(const LcmChannel::Bytes& bytes);
  template <typename Message, typename Convert>
  void take(const Event<Message>& event, const std::string& topic, Convert convert);
  void refuse(const std::string& what);

  const RobotIdentity robot_;
  const std::function<void(const FleetMessage&)> hear_;
  DatagramLink link_;
  int refused_ = 0;
  int unsent_ = 0;
  std::string refusal_;
  ros::Publisher trajectories_out_;
  ros::Publisher heartbeats_out_;
  ros::Publisher intents_out_;
  ros::Publisher instructions_out_;
  ros::Publisher stops_out_;
  ros::Subscriber trajectories_in_;
  ros::Subscriber heartbeats_in_;
  ros::Subscriber intents_in_;
  ros::Subscriber instructions_in_;
  ros::Subscriber stops_in_;
  std::unique_ptr<LcmChannel> channel_;
};

}  // namespace mocha
