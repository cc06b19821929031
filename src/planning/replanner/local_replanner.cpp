#include "planning/replanner/local_replanner.h"

#include <algorithm>
#include <utility>

#include "planning/candidates/exposure.h"
#include "planning/local/rejoining.h"
#include "safety/certifier.h"
#include "trajectory/splice.h"

namespace mocha {
namespace {

constexpr double kSamePlace_m = 0.5;  // of two plans' ends
constexpr double kTarget_s = 6.0;     // along the plan; farther than a maneuver gets
constexpr double kOffPlan_m = 3.0;    // farther from the plan, its end is where to get to

bool is_likely(RequirementName promise) { return promise != RequirementName::kPromise; }

}  // namespace

LocalReplanner::LocalReplanner(const RobotModel& robot, const LocalReplannerOptions& options,
                               const LocalOptions& local_options, const LocalPlanner::Watch& watch)
    : robot_(robot),
      requirements_(robot),
      options_(options),
      detour_(robot, local_options, watch),
      proposals_(options.answer_timeout_s) {}

void LocalReplanner::set_plan(Motion plan, PlanKind kind) {
  offered_ = Offer{std::move(plan), kind};
}

void LocalReplanner::set_committed(std::uint32_t sequence, Motion motion) {
  committed_ = std::move(motion);
  committed_source_ = proposals_.settled(sequence);
}

void LocalReplanner::on_refusal(std::uint32_t sequence) { proposals_.refused(sequence); }

LocalReplanner::Output LocalReplanner::counted(Output output) {
  ++counts_[static_cast<std::size_t>(output.row)];
  return output;
}

LocalReplanner::Output LocalReplanner::step(double now_s, const RobotState& state,
                                            const LocalScene& scene) {
  // What was measured is a little old, and a fast robot is somewhere else by now.
  return counted(decide(now_s, {now_s, predict(state, now_s), state.twist}, scene));
}

LocalReplanner::Output LocalReplanner::decide(double now_s, const RobotState& measured,
                                              const LocalScene& scene) {
  Output output;
  take_offer(now_s, scene, output);
  if (committed_.empty()) {
    if (proposals_.pending(now_s)) {
      output.row = Row::kWait;
    } else {
      stand_or_stop(now_s, measured, output);
    }
    return output;
  }
  if (off_track(now_s, measured)) {
    if (!announced_stop(now_s)) stop_here(now_s, measured, output);
    return output;
  }
  Step step{start_at(now_s, scene), {}, {}, false, proposals_.pending(now_s), false,
            std::move(output)};
  assess(step);
  // Where the promise holds, no maneuver leaves it in the middle of a turn, which it would have to
  // brake.
  if (!step.output.renew_lease)
    step.start.emergency_s = committed_.clean_cut(now_s + options_.emergency_s);
  if (has_nothing_to_drive_to() && go_down_the_ladder(Situation::kNoGoal, step))
    return std::move(step.output);
  if (step.situation != Situation::kHolds && waits_for_answer(step)) {
    step.output.row = Row::kWait;
  } else {
    go_down_the_ladder(step.situation, step);
  }
  return std::move(step.output);
}

ManeuverStart LocalReplanner::start_at(double now_s, const LocalScene& scene) const {
  return {robot_,
          requirements_,
          scene,
          Course::kConfident,
          committed_,
          now_s,
          committed_.switch_time(now_s + options_.emergency_s),
          committed_.switch_time(now_s + options_.settle_s),
          target_at(now_s),
          options_.promise_reach_m};
}

/// Where the plan leads within some seconds.
Vector2 LocalReplanner::target_at(double now_s) const {
  if (plan_.empty()) return committed_.end_pose().position;
  if (follows_plan_at(now_s)) return plan_.position(now_s + kTarget_s);
  const auto progress_s =
      progress_on(plan_, committed_.position(now_s), plan_.start_time(), kOffPlan_m);
  return plan_.position(progress_s ? *progress_s + kTarget_s : plan_.end_time());
}

void LocalReplanner::take_offer(double now_s, const LocalScene& scene, Output& output) {
  if (!offered_) return;
  const bool to_the_same_place =
      !plan_.empty() && !offered_->plan.empty() && offered_->kind == PlanKind::kFree &&
      (plan_.end_pose().position - offered_->plan.end_pose().position).norm() < kSamePlace_m;
  const bool is_proposed = proposals_.pending(now_s) && proposals_.newest_source().plan == plan_id_;
  if (to_the_same_place && (follows_plan_at(now_s) || is_proposed)) {
    const double horizon_s = scene.predicted_until_s - now_s;
    const Violation of_plan = conflict(plan_, now_s, scene, RequirementName::kTrigger, horizon_s);
    const Violation of_offer =
        conflict(offered_->plan, now_s, scene, RequirementName::kTrigger, horizon_s);
    output.keeps_plan = of_offer && (!of_plan || of_plan.time_s > of_offer.time_s);
  }
  if (!output.keeps_plan) replace_plan(std::move(offered_->plan), offered_->kind);
  offered_.reset();
}

void LocalReplanner::replace_plan(Motion plan, PlanKind kind) {
  plan_ = std::move(plan);
  kind_ = kind;
  detour_.forget();
  ++plan_id_;
  plan_required_ = RequirementName::kPromise;
}

bool LocalReplanner::under_way() const {
  return !plan_.empty() &&
         (plan_.end_pose().position - committed_.end_pose().position).norm() > kSamePlace_m;
}

Violation LocalReplanner::conflict(const Motion& plan, double now_s, const LocalScene& scene,
                                   RequirementName trigger, double horizon_s) const {
  if (plan.empty()) return {};
  return conflict_of(plan, kept_apart(scene, requirements_[trigger].from(now_s)),
                     robot_.footprint.circumscribed_radius_m(), now_s, horizon_s);
}

bool LocalReplanner::waits_for_answer(const Step& step) const {
  return step.pending &&
         (proposals_.newest_brakes() ||
          !certify(proposals_.newest(), robot_.footprint, step.start.scene,
                   requirements_[RequirementName::kRenewal].from(step.start.now_s)));
}

void LocalReplanner::assess(Step& step) const {
  const double now_s = step.start.now_s;
  const LocalScene& scene = step.start.scene;
  step.violation = certify(committed_, robot_.footprint, scene,
                           requirements_[RequirementName::kRenewal].from(now_s));
  step.output.renew_lease = !step.violation;
  const RequirementName trigger =
      is_likely(plan_required_) ? RequirementName::kTriggerLikely : RequirementName::kTrigger;
  const bool plan_meets{conflict(plan_, now_s, scene, trigger, options_.mu_pre_s)};
  const bool meets = step.violation.term == ViolatedTerm::kSeparation;
  if (step.violation && committed_.end_time() > now_s) {
    step.situation = meets ? Situation::kThreatened : Situation::kBlocked;
    step.plan_is_clear = !plan_meets && follows_plan_at(now_s) &&
                         step.violation.time_s > committed_source_.follows_until_s;
  } else if (meets && under_way()) {
    step.situation = Situation::kInTheWay;
    step.plan_is_clear = !plan_meets;
  } else {
    step.situation = kind_ == PlanKind::kInTurn ? Situation::kInTurn
                     : plan_meets               ? Situation::kPlanMeets
                                                : Situation::kHolds;
    step.plan_is_clear = true;
  }
}

bool LocalReplanner::go_down_the_ladder(Situation situation, Step& step) {
  const bool holds = situation == Situation::kHolds || situation == Situation::kPlanMeets ||
                     situation == Situation::kInTurn;
  for (const Rung& rung : ladder_of(situation)) {
    if (step.pending && !rung.replaces_pending) continue;
    const Climb climb = try_rung(rung, step);
    if (climb == Climb::kProposed || (climb == Climb::kKeep && holds)) return true;
  }
  return false;
}

LocalReplanner::Climb LocalReplanner::try_rung(const Rung& rung, Step& step) {
  step.start.course = is_likely(rung.required) ? Course::kLikely : Course::kConfident;
  if (rung.maneuver == ManeuverKind::kFollow) return try_follow(step);
  const Maneuvers list = maneuvers(rung, step);
  for (const Maneuver& maneuver : list) {
    const auto part = certified_part(step.start, maneuver, rung.required);
    if (!part || part->follows_until_s < maneuver.least_reach_s) continue;
    if (maneuver.follows == Follows::kPlan) take_detour(rung, step);
    propose(rung, maneuver, *part, step);
    return Climb::kProposed;
  }
  if (rung.maneuver != ManeuverKind::kLastResort) return Climb::kNext;
  const bool stands = committed_.end_time() <= step.start.now_s;
  report(rung, stands ? "stands" : "goes on, which keeps more room than braking", step);
  step.output.renew_lease = true;
  return Climb::kProposed;
}

LocalReplanner::Climb LocalReplanner::try_follow(Step& step) {
  if (!step.plan_is_clear && step.situation != Situation::kPlanMeets) return Climb::kNext;
  auto maneuver = following(step);
  if (!maneuver) return Climb::kKeep;
  const ManeuverStart& start = step.start;
  if (!splice(committed_, start.now_s, maneuver->join_s, maneuver->motion)) {
    ask_for_plan({}, "the plan does not join the promised motion any more", step.output);
    return Climb::kNext;
  }
  const auto part = certified_of(*maneuver, step);
  if (!part) {
    ask_for_plan({}, "nothing of the plan can be promised from here", step.output);
    return Climb::kNext;
  }
  const bool nowhere = part->follows_until_s < std::min(maneuver->least_reach_s, plan_.end_time());
  const bool stands = committed_.at(maneuver->join_s).at_rest;
  const bool waits = committed_source_.plan != plan_id_ && stands;
  // What was not seen yet will be seen on the way.
  const bool unseen = part->cut_by.term == ViolatedTerm::kUnseenSpace;
  step.output.violation = part->cut_by;
  const bool awaits_peer =
      kind_ == PlanKind::kInTurn && part->cut_by.term == ViolatedTerm::kSeparation;
  if (part->cut_by && !awaits_peer && ((waits && nowhere) || !unseen))
    ask_for_plan(part->cut_by, describe(part->cut_by), step.output);
  else if (part->cut_by && nowhere && stands)
    object(part->cut_by, describe(part->cut_by), step.output);
  if (nowhere) {
    const bool meets = part->cut_by.term == ViolatedTerm::kSeparation;
    return meets ? Climb::kNext : Climb::kKeep;
  }
  propose({Row::kFollow, ManeuverKind::kFollow, plan_required_, false}, *maneuver, *part, step);
  return Climb::kProposed;
}

void LocalReplanner::propose(const Rung& rung, const Maneuver& maneuver, const CertifiedPart& part,
                             Step& step) {
  PromiseSource source{committed_source_.plan, 0.0};
  if (maneuver.follows == Follows::kPlan) source = {plan_id_, part.follows_until_s};
  if (maneuver.follows == Follows::kCommitted)
    source.follows_until_s = std::min(committed_source_.follows_until_s, part.follows_until_s);
  const bool brakes = maneuver.follows != Follows::kPlan;
  step.output.proposal =
      proposals_.make(step.start.now_s, part.motion, maneuver.at_once, source, brakes);
  report(rung, maneuver.words, step);
}

void LocalReplanner::report(const Rung& rung, const char* words, Step& step) const {
  Output& output = step.output;
  output.row = rung.row;
  if (rung.row == Row::kFollow) return;
  output.message = words;
  if (!rung.replaces_pending) return;
  if (rung.row == Row::kStop) {
    output.reason = PlanReason::kNoGoal;
    return;
  }
  const bool blocked = step.situation == Situation::kBlocked;
  output.reason = blocked ? PlanReason::kBraking : PlanReason::kPeerConflict;
  output.violation = step.violation;
  output.message = describe(step.violation) + "; " +
                   (rung.row == Row::kLastResort ? "NO CERTIFIED MOTION EXISTS; " : "") + words;
  output.request_plan = step.situation != Situation::kInTheWay;
}

void LocalReplanner::object(const Violation& violation, const std::string& why, Output& output) {
  const bool meets = violation.term == ViolatedTerm::kSeparation;
  output.reason = meets ? PlanReason::kPeerConflict : PlanReason::kNotCertified;
  output.violation = violation;
  output.message = why;
}

void LocalReplanner::ask_for_plan(const Violation& violation, const std::string& why,
                                  Output& output) {
  object(violation, why, output);
  output.request_plan = true;
}

}  // namespace mocha
