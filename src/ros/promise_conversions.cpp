#include "ros/promise_conversions.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "ros/conversions.h"

namespace mocha {
namespace {

PromiseState state_from_message(std::uint8_t state) {
  if (state < static_cast<std::uint8_t>(PromiseState::kProposed) ||
      state > static_cast<std::uint8_t>(PromiseState::kWithdrawn)) {
    throw std::invalid_argument("state = " + std::to_string(state) + " is no promise");
  }
  return static_cast<PromiseState>(state);
}

/// "comes within 0.62 m of ugv2 (demanded are 0.80 m), too close from (1.20, -0.40) on, time 12.35
/// s"
std::string in_words(const Conflict& conflict) {
  char text[200];
  std::snprintf(text, sizeof(text),
                "comes within %.2f m of %s (demanded are %.2f m), too close from (%.2f, %.2f) on, "
                "time %.2f s",
                conflict.distance_m, conflict.peer.c_str(), conflict.required_m, conflict.place.x(),
                conflict.place.y(), conflict.time_s);
  return text;
}

std::string why(const CommitmentEvent& event) {
  switch (event.refusal) {
    case Refusal::kNone:
      return "no refusal";
    case Refusal::kListening:
      return "just started, still listening for who is there";
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

std::uint8_t reason_of(const CommitmentEvent& event) {
  using mocha_ugv::PlannerStatus;
  if (event.kind == CommitmentEvent::Kind::kSettled) return PlannerStatus::SOLVED;
  const bool malformed =
      event.refusal == Refusal::kTooLate || event.refusal == Refusal::kDiscontinuous;
  return malformed ? PlannerStatus::INVALID_INPUT : PlannerStatus::PEER_CONFLICT;
}

}  // namespace

mocha_ugv::Trajectory to_message(const Promise& promise, const std::string& frame,
                                 ros::Time stamp) {
  mocha_ugv::Trajectory message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.state = static_cast<std::uint8_t>(promise.state);
  message.agent = promise.agent;
  message.epoch = promise.id.epoch;
  message.sequence = promise.id.sequence;
  message.priority = promise.priority;
  message.footprint_radius = promise.footprint_radius_m;
  if (promise.motion) to_message(*promise.motion, message);
  return message;
}

mocha_ugv::Heartbeat to_message(const Beat& beat, const std::string& frame, ros::Time stamp) {
  mocha_ugv::Heartbeat message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.agent = beat.agent;
  message.epoch = beat.epoch;
  for (const Seen& line : beat.seen) {
    mocha_ugv::PeerSeen seen;
    seen.agent = line.agent;
    seen.epoch = line.id.epoch;
    seen.sequence = line.id.sequence;
    seen.state = static_cast<std::uint8_t>(line.state);
    message.seen.push_back(seen);
  }
  for (const Echo& line : beat.echoes) {
    mocha_ugv::PeerEcho echo;
    echo.agent = line.agent;
    echo.stamp.fromSec(line.stamp_s);
    echo.held = line.held_s;
    message.echoes.push_back(echo);
  }
  return message;
}

Promise promise_from_message(const mocha_ugv::Trajectory& message, const std::string& frame) {
  if (message.header.frame_id != frame) {
    throw std::invalid_argument("is in frame '" + message.header.frame_id + "', not in '" + frame +
                                "'");
  }
  Promise promise;
  promise.agent = message.agent;
  promise.id = {message.epoch, message.sequence};
  promise.state = state_from_message(message.state);
  promise.priority = message.priority;
  promise.footprint_radius_m = message.footprint_radius;
  if (promise.state != PromiseState::kWithdrawn) {
    promise.motion = std::make_shared<const Motion>(from_message(message));
  }
  validate(promise);
  return promise;
}

Beat beat_from_message(const mocha_ugv::Heartbeat& message) {
  if (message.agent.empty()) throw std::invalid_argument("has no name of a robot");
  Beat beat{message.agent, message.epoch, message.header.stamp.toSec(), {}, {}};
  for (const auto& seen : message.seen) {
    beat.seen.push_back({seen.agent, {seen.epoch, seen.sequence}, state_from_message(seen.state)});
  }
  for (const auto& echo : message.echoes) {
    if (!std::isfinite(echo.held)) throw std::invalid_argument("an echo was held for no time");
    beat.echoes.push_back({echo.agent, echo.stamp.toSec(), echo.held});
  }
  return beat;
}

std::string describe(const CommitmentEvent& event) {
  using Kind = CommitmentEvent::Kind;
  switch (event.kind) {
    case Kind::kSettled:
      return event.promise.state == PromiseState::kEmergency ? "is binding, the robot brakes"
                                                             : "is binding";
    case Kind::kBreached:
      return "the committed motion " + in_words(event.conflict);
    default:
      return why(event);
  }
}

mocha_ugv::PlannerStatus settlement_of(const CommitmentEvent& event, const std::string& frame,
                                       ros::Time stamp) {
  mocha_ugv::PlannerStatus status;
  status.header.stamp = stamp;
  status.header.frame_id = frame;
  status.reason = reason_of(event);
  status.peer = event.conflict.peer;
  status.message = "proposal " + std::to_string(event.proposal.tag) + ": " + describe(event);
  const bool meeting =
      event.refusal == Refusal::kPeerPromise || event.refusal == Refusal::kPeerProposal;
  if (!meeting) return status;
  status.violated = mocha_ugv::PlannerStatus::SEPARATION;
  status.at = ros::Time(event.conflict.time_s);
  status.place.x = event.conflict.place.x();
  status.place.y = event.conflict.place.y();
  status.value = event.conflict.distance_m;
  status.limit = event.conflict.required_m;
  return status;
}

}  // namespace mocha
