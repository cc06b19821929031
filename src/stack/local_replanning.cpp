#include "stack/local_replanning.h"

#include <cstdio>
#include <utility>

namespace mocha {
namespace {

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f s", value);
  return text;
}

}  // namespace

double handover_s(const ParameterTable& values) {
  return values.number("period") + values.number("settle_time");
}

LocalReplanningOptions LocalReplanningOptions::from(const ParameterTable& values) {
  return {values.number("lease"), values.number("max_map_age"), values.number("max_fleet_age"),
          values.number("max_prediction_age")};
}

LocalReplanning::LocalReplanning(const RobotModel& robot, const ParameterTable& values,
                                 double promise_reach_m, DataNames names,
                                 const LocalPlanner::Watch& watch)
    : options_(LocalReplanningOptions::from(values)),
      names_(std::move(names)),
      replanner_(robot, LocalReplannerOptions::from(values, robot, promise_reach_m),
                 LocalOptions::from(values), watch) {}

void LocalReplanning::set_plan(Motion plan, PlanKind kind) {
  if (plan.empty()) step_is_due_ = true;
  replanner_.set_plan(std::move(plan), kind);
}

void LocalReplanning::set_committed(const MotionId& id, Motion motion) {
  replanner_.set_committed(id.sequence, std::move(motion));
  committed_id_ = id;
}

void LocalReplanning::hear(const Answer& answer) {
  if (answer.kind == Answer::Kind::kBreached) step_is_due_ = true;
  if (answer.kind != Answer::Kind::kRefused) return;
  replanner_.on_refusal(answer.sequence);
  ++refused_;
  refusal_ = answer.words;
}

LocalReplanning::Output LocalReplanning::step(double now_s, const LocalKnowledge& known) {
  step_is_due_ = false;
  if (!known.stop.empty()) return {halt(now_s, known), std::nullopt, std::nullopt};
  if (const auto missing = what_is_missing(known))
    return {stop_without(*missing, now_s), std::nullopt, std::nullopt};
  Output output;
  output.scene = known.scene(known.measured->pose.position);
  static_cast<LocalReplanner::Output&>(output) =
      replanner_.step(now_s, *known.measured, *output.scene);
  if (output.renew_lease) output.lease = Lease{committed_id_, now_s + options_.lease_s};
  return output;
}

std::optional<LocalReplanning::Missing> LocalReplanning::what_is_missing(
    const LocalKnowledge& known) const {
  if (!known.measured) return Missing{PlanReason::kNoPose, known.no_pose};
  std::optional<Missing> missing;
  const auto add = [&](bool lacks, PlanReason reason, const std::string& words) {
    if (!lacks) return;
    if (!missing) missing = Missing{reason, ""};
    missing->words += (missing->words.empty() ? "" : "; ") + words;
  };
  const bool has_map = known.map_age_s < LocalKnowledge::kNever_s;
  add(!has_map, PlanReason::kNoMap, "map: none on " + names_.map + " yet");
  add(has_map && known.map_age_s > options_.max_map_age_s, PlanReason::kNoMap,
      "map: the newest on " + names_.map + " is " + seconds(known.map_age_s) + " old");
  add(known.fleet_age_s > options_.max_fleet_age_s, PlanReason::kBraking,
      "fleet: no word from trajectory_broadcaster on " + names_.fleet + " for more than " +
          seconds(options_.max_fleet_age_s));
  add(known.prediction_age_s > options_.max_prediction_age_s, PlanReason::kBraking,
      "people: no usable word from perception on " + names_.predictions + " for more than " +
          seconds(options_.max_prediction_age_s));
  add(!known.sensor_fault.empty(), PlanReason::kBraking, "sensors: " + known.sensor_fault);
  return missing;
}

LocalReplanner::Output LocalReplanning::stop_without(const Missing& missing, double now_s) {
  LocalReplanner::Output output = replanner_.stop_blind(now_s);
  output.reason = missing.reason;
  output.message = missing.words;
  return output;
}

/// Needs no data: what the robot does is promised, whatever it meets.
LocalReplanner::Output LocalReplanning::halt(double now_s, const LocalKnowledge& known) {
  LocalReplanner::Output output;
  if (known.measured) output = replanner_.halt(now_s, *known.measured);
  output.row = Row::kEmergencyStop;
  output.reason = PlanReason::kEmergencyStop;
  output.message = known.measured ? known.stop : known.stop + "; " + known.no_pose;
  return output;
}

}  // namespace mocha
