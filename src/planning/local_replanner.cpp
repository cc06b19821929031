#include "planning/local_replanner.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "fleet/wire_format.h"
#include "planning/conflict.h"
#include "planning/joining.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kStanding_mps = 0.02;
constexpr double kStanding_radps = 0.05;
constexpr double kStandPhase_s = 0.1;
constexpr double kSamePlace_m = 0.5;      // of two plans' ends
constexpr double kShareOfTrigger = 0.75;  // of the clearance to what moves, below which (37) is met
constexpr double kShareOfError = 0.5;     // within which a stop is what was promised
constexpr double kWorthwhile_s =
    0.15;  // a promise that reaches less farther is not worth a message

Motion standing(double now_s, const Pose& pose) {
  return Motion(now_s, {StandPhase{pose, kStandPhase_s}});
}

}  // namespace

LocalReplanner::LocalReplanner(const RobotModel& robot, const LocalReplannerRules& rules,
                               const LocalRules& local_rules, const LocalPlanner::Watch& watch)
    : own_radius_m_(robot.footprint.circumscribed_radius_m()),
      builder_(robot),
      way_out_(robot),
      swerving_(robot, local_rules, watch),
      rules_(rules),
      proposals_(rules.answer_timeout_s) {}

void LocalReplanner::set_plan(Motion plan) { offered_ = std::move(plan); }

void LocalReplanner::set_committed(std::uint32_t sequence, Motion motion) {
  committed_ = std::move(motion);
  committed_source_ = proposals_.settled(sequence);
}

void LocalReplanner::on_refusal(std::uint32_t sequence) { proposals_.refused(sequence); }

void LocalReplanner::propose(double now_s, const Motion& motion, bool emergency,
                             const PromiseSource& source, bool brakes, Output& output) {
  try {
    output.proposal = proposals_.make(now_s, quantised(motion), emergency, source, brakes);
  } catch (const std::invalid_argument& error) {
    output.reason = PlanReason::kInvalidInput;
    output.message = std::string("cannot be said to the others: ") + error.what();
  }
}

LocalReplanner::Output LocalReplanner::step(double now_s, const RobotState& state,
                                            const PromiseScene& scene) {
  Output output;
  // What was measured is a little old, and a fast robot is somewhere else by now.
  const RobotState measured{now_s, predict(state, now_s), state.twist};
  const bool pending = proposals_.pending(now_s);
  take_offer(now_s, scene, output);
  if (committed_.empty()) {
    if (!pending) start(now_s, measured, output);
    return output;
  }
  if (off_track(now_s, measured)) {
    if (!(pending && proposals_.newest_brakes())) stop_here(now_s, measured, output);
    return output;
  }
  const Violation violation = builder_.certify_in_force(committed_, scene, now_s);
  output.renew_lease = !violation;
  const bool in_the_way = violation && committed_.end_time() > now_s;
  const PromiseScene likely = scene.most_likely();
  const PromiseScene& asked = squeezes_ ? likely : scene;
  const bool conflicting{conflict(plan_, now_s, asked, rules_.mu_pre_s)};
  if ((in_the_way || conflicting) && waits_for_answer(now_s, scene)) return output;
  const bool waits_in_the_way =
      violation.term == ViolatedTerm::kSeparation && !in_the_way && under_way();
  const bool brakes_in_the_way =
      in_the_way && follows_plan_at(now_s) && violation.time_s > committed_source_.follows_until_s;
  // What is in the way is not the plan, but that no more of it is promised.
  if ((waits_in_the_way || brakes_in_the_way) && !conflicting && !pending) {
    extend(now_s, asked, 0.0, output);
    if (output.proposal) return output;
  }
  if ((in_the_way || conflicting) && !pending && swerve(now_s, scene, output)) return output;
  if (waits_in_the_way && !pending) {
    step_aside(now_s, violation, scene, output);
  } else if (in_the_way) {
    shorten(now_s, violation, scene, output);
  } else if (!pending && !plan_.empty() && !swerve_less(now_s, scene, output)) {
    extend(now_s, asked, rules_.extend_every_s, output);
  }
  return output;
}

void LocalReplanner::take_offer(double now_s, const PromiseScene& scene, Output& output) {
  if (!offered_) return;
  const bool to_the_same_place =
      !plan_.empty() && !offered_->empty() &&
      (plan_.end_pose().position - offered_->end_pose().position).norm() < kSamePlace_m;
  const bool is_proposed = proposals_.pending(now_s) && proposals_.newest_source().plan == plan_id_;
  if (to_the_same_place && (follows_plan_at(now_s) || is_proposed)) {
    const double horizon_s = scene.predicted_until_s - now_s;
    const Violation of_plan = conflict(plan_, now_s, scene, horizon_s);
    const Violation of_offer = conflict(*offered_, now_s, scene, horizon_s);
    output.keeps_plan = of_offer && (!of_plan || of_plan.time_s > of_offer.time_s);
  }
  if (!output.keeps_plan) replace_plan(std::move(*offered_));
  offered_.reset();
}

void LocalReplanner::replace_plan(Motion plan) {
  plan_ = std::move(plan);
  swerving_.forget();
  ++plan_id_;
  squeezes_ = false;
}

LocalReplanner::Output LocalReplanner::halt(double now_s, const RobotState& state) {
  const Pose here = predict(state, now_s);
  Output output;
  output.reason = PlanReason::kEmergencyStop;
  offered_.reset();
  replace_plan(Motion());
  const Motion stop(now_s, brake_from(here, state.twist.speed, state.twist.yaw_rate,
                                      builder_.stop_deceleration(state.twist)));
  const bool said = proposals_.pending(now_s) && proposals_.newest_brakes();
  if (!said && !is_promised(stop, now_s)) propose(now_s, stop, true, {}, true, output);
  return output;
}

bool LocalReplanner::is_promised(const Motion& stop, double now_s) const {
  if (committed_.empty() || committed_.end_time() > stop.end_time()) return false;
  const Pose promised = committed_.at(now_s).pose;
  const Pose real = stop.at(now_s).pose;
  return (promised.position - real.position).norm() < kShareOfError * rules_.max_error_m &&
         std::abs(wrap_angle(promised.yaw_rad - real.yaw_rad)) <
             kShareOfError * rules_.max_error_rad;
}

Violation LocalReplanner::conflict(const Motion& plan, double now_s, const PromiseScene& scene,
                                   double horizon_s) const {
  if (plan.empty()) return {};
  return conflict_of(plan, builder_.kept_from(scene, now_s, kShareOfTrigger), own_radius_m_, now_s,
                     horizon_s);
}

bool LocalReplanner::waits_for_answer(double now_s, const PromiseScene& scene) const {
  return proposals_.pending(now_s) &&
         (proposals_.newest_brakes() ||
          !builder_.certify_in_force(proposals_.newest(), scene, now_s));
}

void LocalReplanner::start(double now_s, const RobotState& measured, Output& output) {
  const bool standing_still = std::abs(measured.twist.speed) < kStanding_mps &&
                              std::abs(measured.twist.yaw_rate) < kStanding_radps;
  if (standing_still) {
    // There is nothing to be settled about it: unless the others know, they drive through it.
    propose(now_s, standing(now_s, measured.pose), true, {}, false, output);
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
  propose(now_s, stop, true, {}, true, output);
}

void LocalReplanner::step_aside(double now_s, const Violation& violation, const PromiseScene& scene,
                                Output& output) {
  output.reason = PlanReason::kPeerConflict;
  output.violation = violation;
  output.message = describe(violation);
  if (const auto choice = way_out_.aside(committed_, times(now_s), scene)) {
    take(now_s, *choice, output);
  } else {
    do_the_least_bad(now_s, scene, output);
  }
}

void LocalReplanner::shorten(double now_s, const Violation& violation, const PromiseScene& scene,
                             Output& output) {
  const bool something_moves = violation.term == ViolatedTerm::kSeparation;
  output.reason = something_moves ? PlanReason::kPeerConflict : PlanReason::kBraking;
  output.violation = violation;
  output.message = describe(violation);
  output.request_plan = true;
  if (const auto choice = way_out_.proved(committed_, times(now_s), scene, something_moves)) {
    take(now_s, *choice, output);
  } else {
    do_the_least_bad(now_s, scene, output);
  }
}

WayOut::Times LocalReplanner::times(double now_s) const {
  return {now_s, committed_.switch_time(now_s + rules_.emergency_s),
          committed_.switch_time(now_s + rules_.settle_s)};
}

void LocalReplanner::take(double now_s, const WayOut::Choice& choice, Output& output) {
  output.message += "; " + choice.what;
  const double follows_until_s =
      std::min(committed_source_.follows_until_s, choice.follows_until_s);
  propose(now_s, choice.motion, choice.emergency, {committed_source_.plan, follows_until_s}, true,
          output);
}

bool LocalReplanner::under_way() const {
  return !plan_.empty() && !committed_.empty() &&
         (plan_.end_pose().position - committed_.end_pose().position).norm() > kSamePlace_m;
}

void LocalReplanner::do_the_least_bad(double now_s, const PromiseScene& scene, Output& output) {
  if (swerve_harder(now_s, scene, output)) return;
  ++least_bad_;
  const bool something_moves = output.violation.term == ViolatedTerm::kSeparation;
  const WayOut::Choice choice =
      way_out_.least_bad(committed_, times(now_s), scene, something_moves);
  output.message += "; NO CERTIFIED MOTION EXISTS";
  const bool stands = committed_.end_time() <= now_s;
  if (choice.motion.empty() || (stands && choice.emergency)) {
    output.message += "; " + (stands ? "stands" : choice.what);
    output.renew_lease = true;
  } else {
    take(now_s, choice, output);
  }
}

Swerving::Situation LocalReplanner::situation(double now_s) const {
  const double join_s = committed_.switch_time(now_s + rules_.settle_s);
  return {now_s, join_s, committed_, plan_, follows_plan_at(join_s)};
}

bool LocalReplanner::swerve(double now_s, const PromiseScene& scene, Output& output) {
  output.local = swerving_.around(situation(now_s), scene);
  if (!output.local) return false;
  const LocalPlan& found = *output.local;
  if (found.proof > LocalProof::kLikely || !adopt(now_s, scene, output)) return false;
  output.message = "swerves";
  if (found.late || found.beyond)
    ask_for_plan(found.beyond, found.late ? "the swerve takes long" : describe(found.beyond),
                 output);
  return true;
}

bool LocalReplanner::swerve_less(double now_s, const PromiseScene& scene, Output& output) {
  auto found = swerving_.sooner(situation(now_s), scene);
  if (!found) return false;
  output.local = std::move(found);
  if (!adopt(now_s, scene, output)) return false;
  output.message = "swerves less";
  return true;
}

bool LocalReplanner::swerve_harder(double now_s, const PromiseScene& scene, Output& output) {
  if (!output.local || output.local->candidates.empty()) return false;
  if (output.local->proof == LocalProof::kNone)
    output.local = swerving_.harder(situation(now_s), scene, *output.local);
  if (output.local->proof == LocalProof::kNone || !adopt(now_s, scene, output)) return false;
  output.message = "swerves harder than it would like to";
  return true;
}

bool LocalReplanner::adopt(double now_s, const PromiseScene& scene, Output& output) {
  const LocalPlan& local = *output.local;
  const double join_s = local.motion.start_time();
  const bool squeezes = local.proof != LocalProof::kAsked;
  const Motion onward = continued(committed_, now_s, join_s, local.motion);
  const auto promise = builder_.longest(onward, squeezes ? scene.most_likely() : scene, now_s,
                                        join_s, now_s + rules_.horizon_s);
  if (!promise || promise->follows_until_s < join_s + kWorthwhile_s) return false;
  swerving_.take(now_s, plan_, local);
  plan_ = local.motion;
  ++plan_id_;
  squeezes_ = squeezes;
  propose(now_s, remainder(promise->motion, join_s), false, {plan_id_, promise->follows_until_s},
          false, output);
  output.swerves = output.proposal.has_value();
  return output.swerves;
}

void LocalReplanner::extend(double now_s, const PromiseScene& scene, double every_s,
                            Output& output) {
  const bool same_plan = committed_source_.plan == plan_id_;
  const double soonest_s = committed_.switch_time(now_s + rules_.settle_s);
  if (!same_plan) plan_ = postponed(committed_, plan_, soonest_s).value_or(plan_);
  if (plan_.end_time() <= now_s + rules_.settle_s) return;
  const double reach_s = committed_source_.follows_until_s;
  if (same_plan &&
      (reach_s >= plan_.end_time() - 1e-6 || reach_s > now_s + rules_.horizon_s - every_s)) {
    return;
  }
  const double join_s =
      committed_.switch_time(std::max(plan_.start_time(), now_s + rules_.settle_s));
  const auto onward = joined(committed_, plan_, now_s, join_s);
  if (!onward) {
    if (swerve(now_s, scene, output)) return;
    ask_for_plan({}, "the plan does not join the promised motion any more", output);
    return;
  }
  const auto promise = builder_.longest(*onward, scene, now_s, join_s, now_s + rules_.horizon_s);
  if (!promise) {
    if (swerve(now_s, scene, output)) return;
    ask_for_plan({}, "nothing of the plan can be promised from here", output);
    return;
  }
  const bool waits = !same_plan && committed_.at(join_s).at_rest;
  const bool nowhere = (same_plan || waits) && promise->follows_until_s < plan_.end_time() &&
                       promise->follows_until_s < (waits ? join_s : reach_s) + kWorthwhile_s;
  const bool unseen =
      promise->cut_by.term == ViolatedTerm::kUnseenSpace;  // will be seen on the way
  output.violation = promise->cut_by;
  const bool meets_something = promise->cut_by.term == ViolatedTerm::kSeparation;
  if (nowhere && meets_something && swerve(now_s, scene, output)) return;
  if (promise->cut_by && ((waits && nowhere) || !unseen)) {
    ask_for_plan(promise->cut_by, describe(promise->cut_by), output);
  }
  if (nowhere) return;
  propose(now_s, remainder(promise->motion, join_s), false, {plan_id_, promise->follows_until_s},
          false, output);
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
