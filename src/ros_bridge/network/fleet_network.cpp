#include "ros_bridge/network/fleet_network.h"

#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/committed_trajectory_conversions.h"
#include "ros_bridge/messages/emergency_stop_conversions.h"
#include "ros_bridge/messages/passing_conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

std::optional<FleetKey> key_from(const std::string& path) {
  if (path.empty()) return std::nullopt;
  return FleetKey::load(path);
}

}  // namespace

FleetNetwork::FleetNetwork(ros::NodeHandle& node, const RobotIdentity& robot,
                           const FleetNetworkOptions& options,
                           std::function<void(const FleetMessage&)> hear)
    : robot_(robot), hear_(std::move(hear)), link_(robot.name, key_from(options.fleet_key)) {
  if (!options.lcm_url.empty()) {
    channel_ = std::make_unique<LcmChannel>(
        options.lcm_url, [this](const LcmChannel::Bytes& bytes) { on_datagram(bytes); });
    ROS_INFO("%s: hears its fleet on %s", robot.name.c_str(), options.lcm_url.c_str());
    if (!link_.has_key()) {
      ROS_WARN(
          "%s: without fleet_key, ALL ON THE NETWORK ARE TRUSTED: any computer may stop this "
          "robot, or make it believe that there is nothing in its way",
          robot.name.c_str());
    }
    return;
  }
  trajectories_out_ = node.advertise<mocha_ugv::Trajectory>("/fleet/promises", 100);
  heartbeats_out_ = node.advertise<mocha_ugv::Heartbeat>("/fleet/heartbeats", 100);
  intents_out_ = node.advertise<mocha_ugv::PassingIntent>("/fleet/passing_intents", 100);
  instructions_out_ =
      node.advertise<mocha_ugv::PassingInstruction>("/fleet/passing_instructions", 100);
  stops_out_ = node.advertise<mocha_ugv::FleetStops>("/fleet/emergency_stops", 100);
  trajectories_in_ =
      node.subscribe("/fleet/promises", 100, &FleetNetwork::on_trajectory, this, at_once());
  heartbeats_in_ =
      node.subscribe("/fleet/heartbeats", 100, &FleetNetwork::on_heartbeat, this, at_once());
  intents_in_ =
      node.subscribe("/fleet/passing_intents", 100, &FleetNetwork::on_intent, this, at_once());
  instructions_in_ = node.subscribe("/fleet/passing_instructions", 100,
                                    &FleetNetwork::on_instruction, this, at_once());
  stops_in_ =
      node.subscribe("/fleet/emergency_stops", 100, &FleetNetwork::on_stops, this, at_once());
}

void FleetNetwork::send(const FleetMessage& message, ros::Time now) {
  if (channel_) {
    for (const auto& bytes : link_.pack(message)) unsent_ += !channel_->send(bytes);
  } else if (const auto* trajectory = std::get_if<CommittedTrajectory>(&message)) {
    trajectories_out_.publish(to_message(*trajectory, robot_.map_frame, now));
  } else if (const auto* intent = std::get_if<PassingIntent>(&message)) {
    intents_out_.publish(to_message(*intent, robot_.map_frame, now));
  } else if (const auto* instruction = std::get_if<PassingInstruction>(&message)) {
    instructions_out_.publish(to_message(*instruction, robot_.map_frame, now));
  } else if (const auto* stops = std::get_if<FleetStops>(&message)) {
    stops_out_.publish(to_message(*stops, now));
  } else {
    heartbeats_out_.publish(to_message(std::get<Heartbeat>(message), robot_.map_frame, now));
  }
}

void FleetNetwork::on_trajectory(const Event<mocha_ugv::Trajectory>& event) {
  take(event, "/fleet/promises", [this](const mocha_ugv::Trajectory& message) {
    return trajectory_from_message(message, robot_.map_frame);
  });
}

void FleetNetwork::on_heartbeat(const Event<mocha_ugv::Heartbeat>& event) {
  take(event, "/fleet/heartbeats",
       [](const mocha_ugv::Heartbeat& message) { return heartbeat_from_message(message); });
}

void FleetNetwork::on_intent(const Event<mocha_ugv::PassingIntent>& event) {
  take(event, "/fleet/passing_intents", [this](const mocha_ugv::PassingIntent& message) {
    return passing_from_message(message, robot_.map_frame);
  });
}

void FleetNetwork::on_instruction(const Event<mocha_ugv::PassingInstruction>& event) {
  take(event, "/fleet/passing_instructions", [this](const mocha_ugv::PassingInstruction& message) {
    return passing_from_message(message, robot_.map_frame);
  });
}

void FleetNetwork::on_stops(const Event<mocha_ugv::FleetStops>& event) {
  take(event, "/fleet/emergency_stops",
       [](const mocha_ugv::FleetStops& message) { return stops_from_message(message); });
}

/// A message of another robot. The same name from another node is another robot that calls itself
/// like this one.
template <typename Message, typename Convert>
void FleetNetwork::take(const Event<Message>& event, const std::string& topic, Convert convert) {
  if (event.getPublisherName() == ros::this_node::getName()) return;
  try {
    if (event.getMessage()->agent == robot_.name) {
      throw std::invalid_argument("carries this robot's own name but comes from " +
                                  event.getPublisherName());
    }
    hear_(convert(*event.getMessage()));
  } catch (const std::invalid_argument& error) {
    ++refused_;
    refuse(topic + ": " + error.what());
  }
}

void FleetNetwork::on_datagram(const LcmChannel::Bytes& bytes) {
  const int before = link_.counts().refused();
  const auto message = link_.unpack(bytes.data(), bytes.size());
  if (message) hear_(*message);
  if (link_.counts().refused() > before) refuse("LCM: " + link_.last_refusal());
}

void FleetNetwork::refuse(const std::string& what) {
  refusal_ = what;
  ROS_WARN_THROTTLE(1.0, "Refused a message on %s", what.c_str());
}

void FleetNetwork::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  using diagnostic_msgs::DiagnosticStatus;
  const DatagramLink::Counts& counts = link_.counts();
  if (channel_) {
    if (!link_.has_key())
      status.mergeSummary(DiagnosticStatus::WARN, "no fleet_key: all on the network are trusted");
    if (counts.unsealed + counts.foreign > 0)
      status.mergeSummary(DiagnosticStatus::WARN,
                          "robots or strangers without this fleet's key are on the network");
    if (unsent_ > 0)
      status.mergeSummary(DiagnosticStatus::WARN, "the network does not take all datagrams");
    status.add("datagrams sent", counts.sent);
    status.add("datagrams not sent", unsent_);
    status.add("datagrams heard", counts.taken);
    status.add("datagrams heard again", counts.repeated);
    status.add("datagrams without a seal", counts.unsealed);
    status.add("datagrams of another key", counts.foreign);
    status.add("datagrams malformed", counts.malformed);
    status.add("datagrams of too many robots", counts.crowded_out);
    status.add("datagrams too many at once", channel_->dropped());
    status.add("another robot bears this name", counts.impostors);
  }
  status.add("refused messages", refused());
  if (!refusal_.empty()) status.add("last refused message", refusal_);
}

std::optional<double> FleetNetwork::loss(const std::string& peer) const {
  return channel_ ? link_.loss(peer) : std::nullopt;
}

}  // namespace mocha
