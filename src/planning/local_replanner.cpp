#include "planning/local_replanner.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kStanding_mps = 0.02;
constexpr double kStanding_radps = 0.05;
constexpr double kStandPhase_s = 0.1;
constexpr double kJoinTolerance_m = 0.01;
constexpr double kJoinTolerance_rad = 0.03;
constexpr double kJoinTolerance_mps = 0.03;
constexpr double kWorthwhile_s =
    0.15;  // a promise that reaches less farther is not worth a message

Motion standing(double now_s, const Pose& pose) {
  return Motion(now_s, {StandPhase{pose, kStandPhase_s}});
}

bool agree(const MotionState& a, const MotionState& b) {
  return (a.pose.position - b.pose.position).norm() <= kJoinTolerance_m &&
         std::abs(wrap_angle(a.pose.yaw_rad - b.pose.yaw_rad)) <= kJoinTolerance_rad &&
         (a.velocity - b.velocity).norm() <= kJoinTolerance_mps;
}

}  // namespace

LocalReplanner::LocalReplanner(const RobotModel& robot, const LocalReplannerRules& rules)
    : builder_(robot), rules_(rules) {}

void LocalReplanner::set_plan(Motion plan) {
  plan_ = std::move(plan);
  ++plan_id_;
}

void LocalReplanner::set_committed(std::uint32_t sequence, Motion motion) {
  committed_ = std::move(motion);
  const auto source = proposed_.find(sequence);
  committed_source_ = source == proposed_.end() ? Source{} : source->second;
  proposed_.erase(proposed_.begin(), proposed_.upper_bound(sequence));
  if (sequence >= sequence_) pending_until_s_ = 0.0;
  sequence_ = std::max(sequence_, sequence);
}

void LocalReplanner::on_refusal(std::uint32_t sequence) {
  proposed_.erase(sequence);
  if (sequence == sequence_) pending_until_s_ = 0.0;
}

void LocalReplanner::propose(double now_s, Motion motion, bool emergency, Source source,
                             Output& output) {
  ++sequence_;
  proposed_[sequence_] = source;
  pending_until_s_ = now_s + rules_.answer_timeout_s;
  pending_brake_ = false;
  output.proposal = ProposedMotion{sequence_, std::move(motion), emergency};
}

LocalReplanner::Output LocalReplanner::step(double now_s, const RobotState& state,
                                            const PromiseScene& scene) {
  Output output;
  // What was measured is a little old, and a fast robot is somewhere else by now.
  const RobotState measured{now_s, predict(state, now_s), state.twist};
  const bool pending = now_s < pending_until_s_;
  const bool braking = pending && pending_brake_;
  if (committed_.empty()) {
    if (!pending) start(now_s, measured, output);
    return output;
  }
  if (off_track(now_s, measured)) {
    if (!braking) stop_here(now_s, measured, output);
    return output;
  }
  const Violation violation = builder_.certify_in_force(committed_, scene, now_s);
  output.renew_lease = !violation;
  const bool stands = committed_.end_time() <= now_s;
  if (violation && !stands) {
    if (!braking) shorten(now_s, violation, scene, output);
  } else if (!pending && !plan_.empty()) {
    extend(now_s, scene, output);
  }
  return output;
}

void LocalReplanner::start(double now_s, const RobotState& measured, Output& output) {
  const bool standing_still = std::abs(measured.twist.speed) < kStanding_mps &&
                              std::abs(measured.twist.yaw_rate) < kStanding_radps;
  if (standing_still) {
    propose(now_s, standing(now_s + rules_.settle_s, measured.pose), false, {}, output);
    output.message = "promises to stand";
  } else {
    stop_here(now_s, measured, output);
  }
}

bool LocalReplanner::off_track(double now_s, const RobotState& measured) const {
  // A broadcaster that was started again only says what comes next; until then the tracker follows
  // what it has.
  if (now_s < committed_.start_time()) return false;
  const Pose promised = committed_.at(now_s).pose;
  return (promised.position - measured.pose.position).norm() > rules_.max_error_m ||
         std::abs(wrap_angle(promised.yaw_rad - measured.pose.yaw_rad)) > rules_.max_error_rad;
}

void LocalReplanner::stop_here(double now_s, const RobotState& measured, Output& output) {
  const Motion stop(now_s, brake_from(measured.pose, measured.twist.speed, measured.twist.yaw_rate,
                                      builder_.deceleration()));
  output.reason = PlanReason::kBraking;
  std::ostringstream text;
  text.precision(3);
  if (!committed_.empty()) {
    const double error_m = (committed_.at(now_s).pose.position - measured.pose.position).norm();
    text << "is " << error_m << " m off its promised motion (allowed: " << rules_.max_error_m
         << " m): brakes from where it is";
  } else {
    text << "moves without a promise: brakes";
  }
  output.message = text.str();
  output.request_plan = true;
  propose(now_s, stop, true, {}, output);
  pending_brake_ = true;
}

void LocalReplanner::shorten(double now_s, const Violation& violation, const PromiseScene& scene,
                             Output& output) {
  output.reason = violation.term == ViolatedTerm::kSeparation ? PlanReason::kPeerConflict
                                                              : PlanReason::kBraking;
  output.violation = violation;
  output.message = describe(violation);
  output.request_plan = true;
  const double soonest = committed_.switch_time(now_s + rules_.emergency_s);
  const auto safe = builder_.longest(committed_, scene, now_s, soonest, committed_.end_time());
  if (safe) {
    const double join_s = committed_.switch_time(now_s + rules_.settle_s);
    const bool time_to_settle = safe->follows_until_s > join_s;
    const Source source{committed_source_.plan,
                        std::min(committed_source_.follows_until_s, safe->follows_until_s)};
    propose(now_s, time_to_settle ? remainder(safe->motion, join_s) : safe->motion, !time_to_settle,
            source, output);
    pending_brake_ = true;
    output.message += "; brakes in time";
    return;
  }
  output.message += "; no certified stop exists, brakes at once all the same";
  propose(now_s,
          with_brake(committed_, committed_.cut_time(now_s), soonest, builder_.deceleration()),
          true, {}, output);
  pending_brake_ = true;
}

std::optional<Motion> LocalReplanner::joined(double now_s, double& join_s) const {
  join_s = committed_.switch_time(std::max(plan_.start_time(), now_s + rules_.settle_s));
  const bool same_plan =
      committed_source_.plan == plan_id_ && committed_source_.follows_until_s >= join_s;
  if (!same_plan && !agree(committed_.at(join_s), plan_.at(join_s))) return std::nullopt;
  const double begin_s = std::max(committed_.cut_time(now_s), committed_.start_time());
  std::vector<Phase> phases = committed_.phases_between(begin_s, join_s);
  const double stands_from = std::max(begin_s, committed_.end_time());
  if (stands_from < join_s)
    phases.emplace_back(StandPhase{committed_.end_pose(), join_s - stands_from});
  for (Phase& phase : plan_.phases_between(join_s, plan_.end_time()))
    phases.push_back(std::move(phase));
  return Motion(begin_s, std::move(phases));
}

void LocalReplanner::postpone_late_plan(double now_s) {
  const double join_s = committed_.switch_time(now_s + rules_.settle_s);
  if (committed_source_.plan == plan_id_ || plan_.start_time() >= join_s) return;
  const MotionState here = committed_.at(join_s);
  const MotionState start = plan_.at(plan_.start_time());
  const bool stands_there = here.at_rest && start.at_rest && agree(here, start);
  if (stands_there) plan_ = Motion(join_s, plan_.phases());
}

void LocalReplanner::extend(double now_s, const PromiseScene& scene, Output& output) {
  postpone_late_plan(now_s);
  if (plan_.end_time() <= now_s + rules_.settle_s) return;
  const bool same_plan = committed_source_.plan == plan_id_;
  const double reach_s = committed_source_.follows_until_s;
  if (same_plan && (reach_s >= plan_.end_time() - 1e-6 ||
                    reach_s > now_s + rules_.horizon_s - rules_.extend_every_s)) {
    return;
  }
  double join_s;
  std::optional<Motion> onward;
  try {
    onward = joined(now_s, join_s);
  } catch (const std::invalid_argument&) {
    // The ends agree by tolerance but not closely enough for one motion: the same as not agreeing.
  }
  if (!onward) {
    ask_for_plan({}, "the plan does not join the promised motion any more", output);
    return;
  }
  const auto promise = builder_.longest(*onward, scene, now_s, join_s, now_s + rules_.horizon_s);
  if (!promise) {
    ask_for_plan({}, "nothing of the plan can be promised from here", output);
    return;
  }
  const bool waits = !same_plan && committed_.at(join_s).at_rest;
  const bool nowhere = (same_plan || waits) && promise->follows_until_s < plan_.end_time() &&
                       promise->follows_until_s < (waits ? join_s : reach_s) + kWorthwhile_s;
  const bool unseen =
      promise->cut_by.term == ViolatedTerm::kUnseenSpace;  // will be seen on the way
  output.violation = promise->cut_by;
  if (promise->cut_by && ((waits && nowhere) || !unseen)) {
    ask_for_plan(promise->cut_by, describe(promise->cut_by), output);
  }
  if (nowhere) return;
  propose(now_s, remainder(promise->motion, join_s), false, {plan_id_, promise->follows_until_s},
          output);
}

void LocalReplanner::ask_for_plan(const Violation& violation, const std::string& why,
                                  Output& output) {
  const bool peer = violation.term == ViolatedTerm::kSeparation;
  output.reason = peer ? PlanReason::kPeerConflict : PlanReason::kNotCertified;
  output.violation = violation;
  output.message = why;
  output.request_plan = true;
}

}  // namespace mocha
