// What the rows of the ladder try: the maneuvers that need the replanner's plan.
#include <algorithm>
#include <cmath>
#include <utility>

#include "planning/local/rejoining.h"
#include "planning/maneuvers/brake.h"
#include "planning/maneuvers/most_room.h"
#include "planning/maneuvers/sidestep.h"
#include "planning/maneuvers/weave.h"
#include "planning/replanner/local_replanner.h"
#include "trajectory/splice.h"

namespace mocha {
namespace {

constexpr double kWorthwhile_s = 0.15;  // of reach, for which a proposal is made
constexpr double kRounding_s = 1e-6;    // of times
constexpr double kWait_s = 0.25;        // by so much longer each time, for the way to get free ...
constexpr double kLongestWait_s = 4.0;
constexpr double kOnPlan_m = 0.5;  // a place as near to it is on its way

/// A plan from rest that came too late for its own times is as good later, while the robot stands
/// where it begins: the same from `join_s` on. Else the plan as it is.
Motion postponed(const Motion& committed, const Motion& plan, double now_s, double join_s) {
  if (plan.empty() || plan.start_time() >= join_s || !committed.at(join_s).at_rest ||
      !plan.at(plan.start_time()).at_rest)
    return plan;
  Motion later(join_s, plan.phases());
  return splice(committed, now_s, join_s, later) ? later : plan;
}

/// The same, so much later.
Motion after_a_wait(const Motion& motion, double wait_s) {
  std::vector<Phase> phases = {StandPhase{motion.at(motion.start_time()).pose, wait_s}};
  phases.insert(phases.end(), motion.phases().begin(), motion.phases().end());
  return {motion.start_time(), std::move(phases)};
}

/// How long the robot still turns in place before it drives [s]. A promise reaches farther by that,
/// as team-mates wait for what it drives.
double turns_for_s(const Motion& plan, double now_s) {
  const double from_s = std::max(now_s, plan.start_time());
  return plan.switch_time(from_s) - from_s;
}

}  // namespace

Maneuvers LocalReplanner::maneuvers(const Rung& rung, Step& step) {
  switch (rung.maneuver) {
    case ManeuverKind::kFollow:
      break;  // see try_follow()
    case ManeuverKind::kRejoinSooner:
      return rejoining_sooner(step);
    case ManeuverKind::kDetour:
      return detours(rung, step);
    case ManeuverKind::kWeave:
      return weaves(step.start);
    case ManeuverKind::kStop:
      return stops(step);
    case ManeuverKind::kBrakeSoon:
      return brake_soon(step.start);
    case ManeuverKind::kBrakeInTime:
      return brake_in_time(step.start);
    case ManeuverKind::kBrakeInTimeAtOnce:
      return brake_in_time_at_once(step.start);
    case ManeuverKind::kSidestep:
      return sidesteps(step.start);
    case ManeuverKind::kBrakeHard:
      return brake_hard(step.start);
    case ManeuverKind::kEmergencyDetour:
      return emergency_detours(step);
    case ManeuverKind::kMostRoom:
      return most_room(step.start);
    case ManeuverKind::kLastResort:
      return last_resort(step.start);
  }
  return {};
}

Maneuvers LocalReplanner::stops(const Step& step) const {
  const auto stop = sooner_stop(step.start.now_s);
  if (!stop) return {};
  return {whole(*stop, stop->start_time(), true, "stops: no goal")};
}

std::optional<Maneuver> LocalReplanner::following(Step& step) {
  const auto& [robot, requirements, scene, course, committed, now_s, emergency_s, settled_s, target,
               promise_reach_m] = step.start;
  const bool same_plan = committed_source_.plan == plan_id_;
  if (!same_plan) plan_ = postponed(committed, plan_, now_s, settled_s);
  if (plan_.empty() || plan_.end_time() <= now_s + options_.settle_s) return std::nullopt;
  const double reach_s = committed_source_.follows_until_s;
  const bool holds = step.situation == Situation::kHolds || step.situation == Situation::kInTurn;
  const double every_s = holds ? options_.extend_every_s : 0.0;
  // Team-mates wait for what is promised of a stretch.
  const double until_s = kind_ == PlanKind::kInTurn
                             ? plan_.end_time() + kRounding_s
                             : now_s + options_.horizon_s + turns_for_s(plan_, now_s);
  const bool far_enough = reach_s >= plan_.end_time() - kRounding_s || reach_s > until_s - every_s;
  if (same_plan && far_enough) return std::nullopt;
  const double join_s =
      committed.switch_time(std::max(plan_.start_time(), now_s + options_.settle_s));
  const bool waits = !same_plan && committed.at(join_s).at_rest;
  const double least_reach_s = same_plan || waits ? (waits ? join_s : reach_s) + kWorthwhile_s
                                                  : -std::numeric_limits<double>::infinity();
  return Maneuver{join_s,          plan_, join_s,         until_s, least_reach_s,
                  robot.braking(), false, Follows::kPlan, ""};
}

bool LocalReplanner::takes_back(const CertifiedPart& part) const {
  const auto when_at = [this](const Motion& motion) {
    return progress_on(plan_, motion.end_pose().position, plan_.start_time(), kOnPlan_m);
  };
  const auto promised_s = when_at(committed_);
  const auto reached_s = when_at(part.motion);
  return promised_s && reached_s && *reached_s < *promised_s - kWorthwhile_s;
}

std::optional<CertifiedPart> LocalReplanner::certified_of(Maneuver& maneuver, const Step& step) {
  auto part = certified_part(step.start, maneuver, plan_required_);
  const double begins_s = maneuver.motion.start_time();
  const bool rests = committed_.at(maneuver.join_s).at_rest &&
                     std::abs(begins_s - maneuver.join_s) < kRounding_s &&
                     maneuver.motion.at(begins_s).at_rest;
  if (kind_ != PlanKind::kInTurn || !part || part->cut_by.term != ViolatedTerm::kSeparation)
    return part;
  for (double later_s = kWait_s; rests && later_s < kLongestWait_s; later_s += kWait_s) {
    Maneuver late = maneuver;
    late.motion = after_a_wait(maneuver.motion, later_s);
    late.brake_until_s += later_s;
    auto found = certified_part(step.start, late, plan_required_);
    if (!found || found->cut_by) continue;
    plan_ = late.motion;
    maneuver = late;
    return found;
  }
  return takes_back(*part) ? std::nullopt : part;
}

Detour::Start LocalReplanner::detour_start(const Step& step) const {
  const double join_s = step.start.settled_s;
  return {step.start.now_s, join_s, committed_, plan_, follows_plan_at(join_s)};
}

/// The motion that local planning found.
Maneuvers LocalReplanner::detour(const Step& step, const char* words) const {
  const Motion& motion = step.output.local->motion;
  const double join_s = motion.start_time();
  return {{join_s, motion, join_s, step.start.now_s + options_.horizon_s, join_s + kWorthwhile_s,
           robot_.braking(), false, Follows::kPlan, words}};
}

Maneuvers LocalReplanner::detours(const Rung& rung, Step& step) {
  if (!std::exchange(step.searched, true))
    step.output.local = detour_.around(detour_start(step), step.start.scene);
  if (!step.output.local) return {};
  const RequirementName wanted = rung.required == RequirementName::kPromise
                                     ? RequirementName::kDetour
                                     : RequirementName::kDetourLikely;
  return step.output.local->met <= wanted ? detour(step, "takes a detour") : Maneuvers{};
}

Maneuvers LocalReplanner::rejoining_sooner(Step& step) {
  auto found = detour_.sooner(detour_start(step), step.start.scene);
  if (!found) return {};
  step.output.local = std::move(found);
  return detour(step, "shortens its detour");
}

Maneuvers LocalReplanner::emergency_detours(Step& step) {
  auto& local = step.output.local;
  if (!local || local->candidates.empty()) return {};
  if (local->met == RequirementName::kNone)
    local = detour_.harder(detour_start(step), step.start.scene, *local);
  return local->met == RequirementName::kNone ? Maneuvers{}
                                              : detour(step, "takes an emergency detour");
}

void LocalReplanner::take_detour(const Rung& rung, Step& step) {
  const LocalPlan& local = *step.output.local;
  // Whatever the plan was asked for again for, this leads back to it.
  step.output.reason = PlanReason::kSolved;
  step.output.violation = {};
  step.output.request_plan = false;
  detour_.take(step.start.now_s, plan_, local);
  plan_ = local.motion;
  ++plan_id_;
  plan_required_ = rung.required == RequirementName::kPromise ? RequirementName::kPromise
                                                              : RequirementName::kPromiseLikely;
  step.output.swerves = true;
  if (!local.late && !local.beyond) return;
  ask_for_plan(local.beyond, local.late ? "the detour takes long" : describe(local.beyond),
               step.output);
}

}  // namespace mocha
