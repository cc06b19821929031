#include "ros_bridge/messages/status_conversions.h"

#include <stdexcept>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/rviz/candidate_drawing.h"

namespace mocha {

// The enumerations are sent as their numbers.
using Status = mocha_ugv::PlannerStatus;
static_assert(static_cast<int>(PlanReason::kCannotWin) == Status::CANNOT_WIN);
static_assert(static_cast<int>(PlanReason::kEmergencyStop) == Status::EMERGENCY_STOP);
static_assert(static_cast<int>(PlanReason::kPaused) == Status::PAUSED);
static_assert(static_cast<int>(PlanReason::kPeerConflict) == Status::PEER_CONFLICT);
static_assert(static_cast<int>(ViolatedTerm::kSeparation) == Status::SEPARATION);
static_assert(static_cast<int>(ViolatedTerm::kUnseenSpace) == Status::UNSEEN_SPACE);
static_assert(static_cast<int>(ViolatedTerm::kWheelSpeed) == Status::WHEEL_SPEED);
static_assert(static_cast<int>(ViolatedTerm::kSpeedBackward) == Status::SPEED_BACKWARD);
static_assert(static_cast<int>(ViolatedTerm::kZoneSpeed) == Status::ZONE_SPEED);
using EffortMessage = mocha_ugv::PlanningEffort;
static_assert(static_cast<int>(Parameterisation::kCamouflage) == EffortMessage::CAMOUFLAGE);
static_assert(static_cast<int>(Parameterisation::kWaypoints) == EffortMessage::WAYPOINTS);
using FallbackMessage = mocha_ugv::Fallback;
static_assert(static_cast<int>(FallbackKind::kLatticePath) == FallbackMessage::LATTICE_PATH);
static_assert(static_cast<int>(FallbackKind::kSlowedDown) == FallbackMessage::SLOWED_DOWN);
using ReplannerStatus = mocha_ugv::ReplannerStatus;
static_assert(static_cast<int>(Row::kEmergencyStop) == ReplannerStatus::EMERGENCY_STOP);
static_assert(static_cast<int>(Row::kDetourLikely) == ReplannerStatus::DETOUR_LIKELY);
static_assert(static_cast<int>(Row::kSidestepLikely) == ReplannerStatus::SIDESTEP_LIKELY);
static_assert(static_cast<int>(Row::kLastResort) == ReplannerStatus::LAST_RESORT);

Status to_message(PlanReason reason, const Violation& violation, const std::string& text,
                  const std::string& frame, ros::Time stamp) {
  Status status;
  status.header.frame_id = frame;
  status.header.stamp = stamp;
  status.reason = static_cast<uint8_t>(reason);
  status.message = text;
  status.violated = static_cast<uint8_t>(violation.term);
  if (!violation) return status;
  status.at = ros_time(violation.time_s);
  status.place.x = violation.place.x();
  status.place.y = violation.place.y();
  status.value = violation.value;
  status.limit = violation.limit;
  status.peer = violation.peer;
  return status;
}

GoalExecutive::Report from_message(const Status& status) {
  if (status.reason > Status::PAUSED) throw std::invalid_argument("has a reason that is none");
  if (status.violated > Status::ZONE_SPEED) throw std::invalid_argument("violates an unknown term");
  GoalExecutive::Report report;
  report.reason = static_cast<PlanReason>(status.reason);
  report.message = status.message;
  report.violation.term = static_cast<ViolatedTerm>(status.violated);
  report.violation.time_s = status.at.toSec();
  report.violation.place = {status.place.x, status.place.y};
  report.violation.value = status.value;
  report.violation.limit = status.limit;
  report.violation.peer = status.peer;
  return report;
}

FallbackMessage to_message(FallbackKind kind, const FallbackCount& count) {
  FallbackMessage message;
  message.kind = static_cast<uint8_t>(kind);
  message.message = describe(Fallback{kind, count.place});
  message.place.x = count.place.x();
  message.place.y = count.place.y();
  message.plans = count.plans;
  message.in_last_plan = count.in_last_plan;
  return message;
}

EffortMessage to_message(const PlanningRecord& record) {
  EffortMessage effort;
  effort.time = record.last().took_s;
  effort.time_median = record.quantile_s(0.5);
  effort.time_95 = record.quantile_s(0.95);
  effort.time_longest = record.quantile_s(1.0);
  effort.plans = record.plans();
  effort.classes = record.last().classes;
  effort.evaluations = record.last().evaluations;
  effort.parameterisation = static_cast<uint8_t>(record.last().parameterisation);
  for (const auto& [kind, count] : record.fallbacks())
    effort.fallbacks.push_back(to_message(kind, count));
  return effort;
}

const char* to_text(Parameterisation parameterisation) {
  switch (parameterisation) {
    case Parameterisation::kCamouflage:
      return "camouflage";
    case Parameterisation::kWaypoints:
      return "waypoints";
    case Parameterisation::kNone:
      break;
  }
  return "nothing";
}

mocha_ugv::ReplannerStatus to_message(Row row, const Status& status) {
  mocha_ugv::ReplannerStatus message;
  message.header = status.header;
  message.row = static_cast<uint8_t>(row);
  message.doing = to_text(row);
  message.status = status;
  return message;
}

std::vector<mocha_ugv::CostTerm> cost_terms_message(const CostTerms& terms) {
  std::vector<mocha_ugv::CostTerm> messages;
  for (const auto& [name, value] : terms) {
    mocha_ugv::CostTerm& term = messages.emplace_back();
    term.name = name;
    term.value = value;
  }
  return messages;
}

mocha_ugv::Candidate to_message(const PlanCandidate& candidate, const std::string& frame,
                                ros::Time stamp) {
  mocha_ugv::Candidate message;
  message.signature.assign(candidate.signature.begin(), candidate.signature.end());
  message.selected = candidate.selected;
  message.cost = candidate.cost;
  message.terms = cost_terms_message(candidate.terms);
  message.status =
      to_message(candidate.reason, candidate.violation, outcome(candidate), frame, stamp);
  message.status.effort.evaluations = candidate.evaluations;
  message.status.effort.parameterisation = static_cast<uint8_t>(candidate.parameterisation);
  for (const Fallback& fallback : candidate.fallbacks)
    message.status.effort.fallbacks.push_back(to_message(fallback.kind, {0, fallback.place, true}));
  if (!candidate.motion.empty()) {
    message.duration = candidate.motion.end_time() - candidate.motion.start_time();
    message.length = candidate.motion.length_m();
  }
  for (const Vector2& point : drawn_path(candidate)) {
    geometry_msgs::Point place;
    place.x = point.x();
    place.y = point.y();
    message.path.push_back(place);
  }
  return message;
}

}  // namespace mocha
