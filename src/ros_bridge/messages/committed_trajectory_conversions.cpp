#include "ros_bridge/messages/committed_trajectory_conversions.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "ros_bridge/messages/conversions.h"

namespace mocha {
namespace {

TrajectoryState state_from_message(std::uint8_t state) {
  if (state < static_cast<std::uint8_t>(TrajectoryState::kProposed) ||
      state > static_cast<std::uint8_t>(TrajectoryState::kWithdrawn)) {
    throw std::invalid_argument("state = " + std::to_string(state) + " is no promise");
  }
  return static_cast<TrajectoryState>(state);
}

/// "comes within 0.62 m of ugv2 (demanded are 0.80 m), too close from (1.20, -0.40) on, time 12.35
/// s"
std::string in_words(const Conflict& conflict) {
  char text[240];
  std::snprintf(text, sizeof(text),
                "%scomes within %.2f m of %s (demanded are %.2f m), too close from (%.2f, %.2f) "
                "on, time %.2f s",
                conflict.by_stopping ? "where one of them brakes " : "", conflict.distance_m,
                conflict.peer.c_str(), conflict.required_m, conflict.place.x(), conflict.place.y(),
                conflict.time_s);
  return text;
}

std::string why(const CommitmentEvent& event) {
  switch (event.refusal) {
    case Refusal::kNone:
      return "no refusal";
    case Refusal::kListening:
      return "just started, still listening for peers";
    case Refusal::kTooLate:
      return "starts before it can be settled";
    case Refusal::kDiscontinuous:
      return "does not begin where the committed motion will be then";
    case Refusal::kPeerPromise:
      return in_words(event.conflict) + ": that is promised";
    case Refusal::kPeerProposal:
      return in_words(event.conflict) + ": that is proposed at the same time and ranks higher";
    case Refusal::kUnanswered:
      return event.conflict.peer + " did not agree before the motion had to start";
    case Refusal::kClock:
      return "the clock of " + event.conflict.peer +
             " could not be told before the motion had to start";
    case Refusal::kReplaced:
      return "replaced by a newer proposal";
    case Refusal::kEmergency:
      return "dropped, the robot brakes";
  }
  return "unknown refusal";
}

std::uint8_t result_of(CommitmentEvent::Kind kind) {
  using Kind = CommitmentEvent::Kind;
  using mocha_ugv::Settlement;
  switch (kind) {
    case Kind::kSettled:
      return Settlement::SETTLED;
    case Kind::kBreached:
      return Settlement::BREACHED;
    case Kind::kRejected:
    case Kind::kWithdrawn:
      return Settlement::REJECTED;
  }
  return Settlement::INVALID;
}

}  // namespace

mocha_ugv::Trajectory to_message(const CommittedTrajectory& trajectory, const std::string& frame,
                                 ros::Time stamp) {
  mocha_ugv::Trajectory message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.state = static_cast<std::uint8_t>(trajectory.state);
  message.agent = trajectory.agent;
  message.epoch = trajectory.id.epoch;
  message.sequence = trajectory.id.sequence;
  message.priority = trajectory.priority;
  message.footprint_radius = trajectory.footprint_radius_m;
  if (trajectory.braking) to_message(*trajectory.braking, message);
  if (trajectory.motion) to_message(*trajectory.motion, message);
  return message;
}

mocha_ugv::Heartbeat to_message(const Heartbeat& heartbeat, const std::string& frame,
                                ros::Time stamp) {
  mocha_ugv::Heartbeat message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.agent = heartbeat.agent;
  message.epoch = heartbeat.epoch;
  message.promise_reach = heartbeat.promise_reach_m;
  for (const Acknowledgement& line : heartbeat.acknowledgements) {
    mocha_ugv::PeerAcknowledgement acknowledgement;
    acknowledgement.agent = line.agent;
    acknowledgement.epoch = line.id.epoch;
    acknowledgement.sequence = line.id.sequence;
    acknowledgement.state = static_cast<std::uint8_t>(line.state);
    message.acknowledgements.push_back(acknowledgement);
  }
  for (const Echo& line : heartbeat.echoes) {
    mocha_ugv::PeerEcho echo;
    echo.agent = line.agent;
    echo.stamp.fromSec(line.stamp_s);
    echo.held = line.held_s;
    message.echoes.push_back(echo);
  }
  return message;
}

CommittedTrajectory trajectory_from_message(const mocha_ugv::Trajectory& message,
                                            const std::string& frame) {
  if (message.header.frame_id != frame) {
    throw std::invalid_argument("is in frame '" + message.header.frame_id + "', not in '" + frame +
                                "'");
  }
  CommittedTrajectory trajectory;
  trajectory.agent = message.agent;
  trajectory.id = {message.epoch, message.sequence};
  trajectory.state = state_from_message(message.state);
  trajectory.priority = message.priority;
  trajectory.footprint_radius_m = message.footprint_radius;
  if (trajectory.state != TrajectoryState::kWithdrawn) {
    trajectory.braking = braking_from_message(message);
    trajectory.motion = std::make_shared<const Motion>(from_message(message));
  }
  validate(trajectory);
  return trajectory;
}

Heartbeat heartbeat_from_message(const mocha_ugv::Heartbeat& message) {
  if (message.agent.empty()) throw std::invalid_argument("has no name of a robot");
  if (!(message.promise_reach >= 0.0 && std::isfinite(message.promise_reach)))
    throw std::invalid_argument("promise_reach is no distance");
  Heartbeat heartbeat{message.agent,        message.epoch, message.header.stamp.toSec(), {}, {},
                      message.promise_reach};
  for (const auto& acknowledgement : message.acknowledgements) {
    heartbeat.acknowledgements.push_back({acknowledgement.agent,
                                          {acknowledgement.epoch, acknowledgement.sequence},
                                          state_from_message(acknowledgement.state)});
  }
  for (const auto& echo : message.echoes) {
    if (!std::isfinite(echo.held)) throw std::invalid_argument("an echo was held for no time");
    heartbeat.echoes.push_back({echo.agent, echo.stamp.toSec(), echo.held});
  }
  return heartbeat;
}

std::string describe(const CommitmentEvent& event) {
  using Kind = CommitmentEvent::Kind;
  switch (event.kind) {
    case Kind::kSettled:
      return event.trajectory.state == TrajectoryState::kEmergency ? "is binding, the robot brakes"
                                                                   : "is binding";
    case Kind::kBreached:
      return "the committed motion " + in_words(event.conflict);
    default:
      return why(event);
  }
}

mocha_ugv::Settlement settlement_of(const Settled& settled, const std::string& frame,
                                    ros::Time stamp) {
  const CommitmentEvent& event = settled.event;
  mocha_ugv::Settlement settlement;
  settlement.header.stamp = stamp;
  settlement.header.frame_id = frame;
  settlement.result = result_of(event.kind);
  settlement.refusal = static_cast<std::uint8_t>(event.refusal);
  settlement.epoch = event.trajectory.id.epoch;
  settlement.sequence = settled.sequence;
  settlement.peer = event.conflict.peer;
  settlement.at = ros::Time(event.conflict.time_s);
  settlement.place.x = event.conflict.place.x();
  settlement.place.y = event.conflict.place.y();
  settlement.distance = event.conflict.distance_m;
  settlement.required = event.conflict.required_m;
  settlement.message = describe(event);
  return settlement;
}

Answer answer_from_message(const mocha_ugv::Settlement& settlement) {
  using mocha_ugv::Settlement;
  const auto kind = settlement.result == Settlement::SETTLED    ? Answer::Kind::kSettled
                    : settlement.result == Settlement::BREACHED ? Answer::Kind::kBreached
                                                                : Answer::Kind::kRefused;
  return {kind, settlement.sequence, settlement.message};
}

}  // namespace mocha
