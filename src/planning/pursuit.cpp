#include "planning/pursuit.h"

#include <cmath>
#include <utility>

#include "planning/front_end.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kSoonest_s = 0.2;  // between two plans, whoever asks
constexpr double kSamePlace_m = 0.5;
constexpr double kSameGoal_m = 0.05;
constexpr double kAfterEnd_s = 0.5;   // a plan that ended this long ago without arrival has failed
constexpr double kRounding_s = 1e-6;  // of differences of times
constexpr double kLook_s = 0.25;      // between two looks whether it is in anybody's way
constexpr double kPatience_s = 1.5;   // of standing in front of others, until it asks for the way
constexpr double kAgain_s = 0.5;      // a request in force is said again
constexpr double kOnPlan_m = 0.5;     // farther off its plan, a robot drives something else
constexpr double kStanding_mps = 0.03;
constexpr double kStanding_radps = 0.03;

}  // namespace

PursuitRules PursuitRules::from(const ParameterTable& values) {
  return {values.number("planning_time"),         values.number("replan_period"),
          values.number("retry_period"),          values.number("better_by"),
          values.number("occupied_goal_timeout"), GoalRules::from(values)};
}

Pursuit::Pursuit(const PursuitRules& rules, double deceleration, RightOfWay right_of_way)
    : rules_(rules),
      deceleration_(deceleration),
      right_of_way_(std::move(right_of_way)),
      goals_(rules.goals) {}

void Pursuit::set_rules(const PursuitRules& rules, const PlannerRules& planner) {
  right_of_way_.set_rules(planner);
  rules_ = rules;
  goals_.set_rules(rules.goals);
}

void Pursuit::take(std::deque<Goal> goals, double now_s) {
  goals_.set(std::move(goals), now_s);
  begin_goal();
}

void Pursuit::begin_goal() {
  plan_ = Motion();
  retreats_ = false;
  goal_is_new_ = true;
  occupied_since_s_.reset();
  refuge_.reset();
  at_refuge_ = false;
  stands_since_s_.reset();
  withdraws_ = asks_;
  asks_ = false;
  right_of_way_.set_stuck(false);
}

void Pursuit::follow(Motion followed) {
  if (goals_.empty() || goal_is_new_ || retreats_) return;
  const Vector2 end = followed.end_pose().position;
  if ((end - goals_.current().position).norm() < kSamePlace_m) plan_ = std::move(followed);
}

Motion Pursuit::brake(const Motion& committed, double now_s) const {
  const double from_s = committed.switch_time(now_s + rules_.planning_time_s);
  return Motion(from_s, brake_along(committed, from_s, deceleration_));
}

Motion Pursuit::stop(const Motion& committed, double now_s) {
  goals_.clear();
  begin_goal();
  if (!committed.empty()) plan_ = brake(committed, now_s);
  return plan_;
}

Pursuit::Output Pursuit::step(double now_s, const RobotState& state, const Motion& committed,
                              const Outlook& outlook) {
  Output output;
  trail_.add(state);
  if (!goals_.empty()) pursue(now_s, state, committed, outlook, output);
  if (withdraws_ && !output.request) output.request = right_of_way_.request_for({}, right_of_way_.own());
  withdraws_ = false;
  return output;
}

void Pursuit::pursue(double now_s, const RobotState& state, const Motion& committed,
                     const Outlook& outlook, Output& output) {
  if (refuge_) goals_.wait(now_s);
  switch (goals_.update(now_s, state)) {
    case GoalQueue::Event::kAllReached:
      output.ending = Ending::kReached;
      begin_goal();
      return;
    case GoalQueue::Event::kReached:
      begin_goal();
      break;
    case GoalQueue::Event::kTimedOut:
      output.ending = Ending::kNoProgress;
      output.plan = stop(committed, now_s);
      return;
    case GoalQueue::Event::kNone:
      break;
  }
  make_room(now_s, state, committed, outlook, output);
  if (due(now_s)) plan(now_s, committed, outlook, output);
  ask(now_s, state, outlook, output);
}

bool Pursuit::has_plan(double now_s) const {
  return !plan_.empty() && now_s < plan_.end_time() + kAfterEnd_s;
}

bool Pursuit::due(double now_s) const {
  const double since_s = now_s - planned_at_s_ + kRounding_s;
  if (goal_is_new_) return true;
  if (refuge_ && !at_refuge_ && has_plan(now_s) && !requested_ && !retreats_) return false;
  const bool retreat_ends = retreats_ && now_s > plan_.end_time() - rules_.planning_time_s;
  if (requested_ || retreat_ends) return since_s >= kSoonest_s;
  if (retreats_) return false;
  return since_s >= (has_plan(now_s) ? rules_.replan_period_s : rules_.retry_period_s);
}

PlanQuery Pursuit::query_to(const Goal& goal, const Motion& committed, double now_s) const {
  PlanQuery query;
  query.committed = committed;
  query.start_time_s = committed.switch_time(now_s + rules_.planning_time_s);
  query.goal = goal.position;
  query.goal_yaw_rad = goal.yaw_rad;
  query.trail = trail_.points();
  return query;
}

Goal Pursuit::target() const {
  return refuge_ && !at_refuge_ ? Goal{*refuge_, std::nullopt} : goals_.asked();
}

void Pursuit::plan(double now_s, const Motion& committed, const Outlook& outlook, Output& output) {
  if (!outlook.plan || committed.empty()) {
    output.report = Report();
    output.report->reason = outlook.plan ? PlanReason::kNoPose : PlanReason::kNoMap;
    output.report->message =
        outlook.plan ? "nothing is committed yet that a plan could start from" : "no map yet";
    return;
  }
  PlanQuery query = query_to(target(), committed, now_s);
  if (!goal_is_new_ && !retreats_) query.driven = plan_;
  output.planned = Planned{target(), outlook.plan(query)};
  const PlanResult& result = output.planned->result;
  const bool improvement = !goal_is_new_ && !requested_ && !retreats_ && has_plan(now_s);
  planned_at_s_ = now_s;
  requested_ = false;
  if (waits_for_others(result, committed, now_s, output)) return;
  if (improvement && (result.motion.empty() || !much_better(result, now_s))) return;
  output.report = Report{result.reason, result.violation, result.message};
  goal_is_new_ = false;
  if (result.motion.empty()) {
    on_failure(result, committed, now_s, output);
    return;
  }
  occupied_since_s_.reset();
  retreats_ = result.reason == PlanReason::kBackingOut;
  if (at_refuge_) {
    refuge_.reset();
    at_refuge_ = false;
  }
  if (!retreats_ && !refuge_) goals_.move_current(result.goal);
  plan_ = result.motion;
  output.plan = plan_;
}

/// A plan to the goal that would meet a higher one is not driven; where there is no other, the robot
/// waits where it is, which is in nobody's way.
bool Pursuit::waits_for_others(const PlanResult& result, const Motion& committed, double now_s,
                               Output& output) {
  const bool to_goal = !refuge_ || at_refuge_;
  if (!to_goal || result.motion.empty() || !right_of_way_.meets(result.motion, now_s)) return false;
  if (has_plan(now_s) && !at_refuge_) return true;
  goal_is_new_ = false;
  refuge_ = committed.end_pose().position;
  output.report = Report();
  output.report->reason = PlanReason::kPeerConflict;
  output.report->message = "waits until " + right_of_way_.foremost(now_s).agent + " has passed";
  return true;
}

/// Quicker by far; or it leads to the goal itself, or farther, than where it was occupied before.
bool Pursuit::much_better(const PlanResult& result, double now_s) const {
  const Vector2& asked = goals_.asked().position;
  const double nearer_m = (goals_.current().position - asked).norm() - (result.goal - asked).norm();
  if (std::abs(nearer_m) > kSameGoal_m) return nearer_m > 0.0;
  const double remaining_s = plan_.end_time() - now_s;
  return result.motion.end_time() < plan_.end_time() - rules_.better_by * remaining_s;
}

void Pursuit::on_failure(const PlanResult& result, const Motion& committed, double now_s,
                         Output& output) {
  if (refuge_ && !at_refuge_) {
    plan_ = brake(committed, now_s);
    output.plan = plan_;
    return;
  }
  if (result.reason != PlanReason::kGoalOccupied) {
    occupied_since_s_.reset();
    return;
  }
  if (!occupied_since_s_) occupied_since_s_ = now_s;
  if (now_s - *occupied_since_s_ < rules_.occupied_goal_timeout_s) return;
  output.ending = Ending::kGoalOccupied;
  output.plan = stop(committed, now_s);
}

void Pursuit::make_room(double now_s, const RobotState& state, const Motion& committed,
                        const Outlook& outlook, Output& output) {
  const bool rests = std::abs(state.twist.speed) < kStanding_mps &&
                     std::abs(state.twist.yaw_rate) < kStanding_radps;
  at_refuge_ = refuge_ && rests &&
               (state.pose.position - *refuge_).norm() < rules_.goals.tolerance_m;
  if (now_s < looked_s_ + kLook_s || !outlook.scene || committed.empty()) return;
  looked_s_ = now_s;
  if (refuge_ && !right_of_way_.yields(now_s)) {
    begin_goal();
    return;
  }
  const bool in_the_way = refuge_          ? right_of_way_.in_the_way(*refuge_, now_s)
                          : has_plan(now_s) ? right_of_way_.meets(plan_, now_s)
                                            : right_of_way_.in_the_way(state.pose.position, now_s);
  if (!in_the_way) return;
  const Motion braking = brake(committed, now_s);
  const Vector2 from = braking.end_pose().position;
  const auto refuge = right_of_way_.refuge(
      from, outlook.scene({from, goals_.asked().position}), now_s);
  const bool stuck = right_of_way_.stuck();
  begin_goal();
  right_of_way_.set_stuck(stuck);
  refuge_ = refuge;
  if (!refuge || (*refuge - from).norm() > rules_.goals.tolerance_m) return;
  goal_is_new_ = false;
  planned_at_s_ = now_s;
  plan_ = braking;
  output.plan = plan_;
}

/// The way of the plan that is being driven, or else that on the map.
std::vector<Vector2> Pursuit::wanted_way(double now_s, const RobotState& state,
                                         const PlanningScene& scene) const {
  const Vector2& here = state.pose.position;
  const Vector2 there = refuge_ ? *refuge_ : goals_.current().position;
  const bool on_plan = has_plan(now_s) && !retreats_ &&
                       (plan_.position(now_s) - here).norm() < kOnPlan_m &&
                       (plan_.end_pose().position - there).norm() < kSamePlace_m;
  if (!on_plan) return right_of_way_.way(here, there, scene);
  std::vector<Vector2> way = path_of(plan_, now_s, 1.0);
  way.insert(way.begin(), here);
  return way;
}

void Pursuit::ask(double now_s, const RobotState& state, const Outlook& outlook, Output& output) {
  const bool rests = std::abs(state.twist.speed) < kStanding_mps &&
                     std::abs(state.twist.yaw_rate) < kStanding_radps;
  if (at_refuge_ || !outlook.scene) {
    withdraws_ = withdraws_ || asks_;
    asks_ = false;
  }
  if (at_refuge_ || !outlook.scene || !rests) stands_since_s_.reset();
  if (at_refuge_ || !outlook.scene) return;
  if (rests && !stands_since_s_) stands_since_s_ = now_s;
  if (!asks_ && (!stands_since_s_ || now_s < *stands_since_s_ + kPatience_s)) return;
  if (now_s < asked_s_ + kAgain_s) return;
  asked_s_ = now_s;
  const PlanningScene scene = outlook.scene({state.pose.position, goals_.current().position});
  const std::vector<Vector2> way = wanted_way(now_s, state, scene);
  if (way.empty() || (!asks_ && !right_of_way_.blocked(way, scene, now_s))) return;
  asks_ = true;
  const bool for_another = refuge_ && right_of_way_.yields(now_s);
  output.request = right_of_way_.request_for(
      way, for_another ? right_of_way_.foremost(now_s) : right_of_way_.own());
}

}  // namespace mocha
